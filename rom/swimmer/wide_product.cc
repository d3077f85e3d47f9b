#include <rom/swimmer/wide_product.h>

// Sanitizers cannot watch the code that chooses; the compiler must know the name, the loader how to choose.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && __GNUC__ >= 12 &&                              \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SWIMTWIN_FOR_WIDE_VECTORS_TOO __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define SWIMTWIN_FOR_WIDE_VECTORS_TOO
#endif

namespace swimtwin
{
  namespace
  {
    /// Four columns at a time, so that the result is loaded and stored a quarter as often.
    SWIMTWIN_FOR_WIDE_VECTORS_TOO void set_product(const Eigen::Index n_rows, const Eigen::Index n_columns,
                                                   const double *__restrict A, const double *__restrict x,
                                                   double *__restrict result)
    {
      for (Eigen::Index row = 0; row < n_rows; ++row)
        result[row] = 0.;
      Eigen::Index column = 0;
      for (; column + 4 <= n_columns; column += 4)
      {
        const double *a = A + column * n_rows, *b = a + n_rows, *c = b + n_rows, *d = c + n_rows, *y = x + column;
        for (Eigen::Index row = 0; row < n_rows; ++row)
          result[row] += a[row] * y[0] + b[row] * y[1] + c[row] * y[2] + d[row] * y[3];
      }
      for (; column < n_columns; ++column)
        for (Eigen::Index row = 0; row < n_rows; ++row)
          result[row] += A[column * n_rows + row] * x[column];
    }
  } // namespace

  void set_product(const Eigen::MatrixXd &A, const double *const x, double *const result)
  {
    set_product(A.rows(), A.cols(), A.data(), x, result);
  }
} // namespace swimtwin
