#include <rom/swimmer/lower_triangular.h>

namespace swimtwin
{
  void set_lower_product(const VelocityMatrix &A, const VelocityMatrix &B, VelocityMatrix &product)
  {
    const Eigen::Index n = A.rows();
    product.setZero();
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index k = j; k < n; ++k)
        for (Eigen::Index i = k; i < n; ++i)
          product(i, j) += A(i, k) * B(k, j);
  }

  void add_lower_square(const double weight, const VelocityMatrix &F, VelocityMatrix &sum)
  {
    const Eigen::Index n = F.rows();
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::Index j = k; j < n; ++j)
        for (Eigen::Index i = j; i < n; ++i)
          sum(i, j) += weight * F(i, k) * F(j, k);
  }

  VelocityVector lower_times(const VelocityMatrix &L, const VelocityVector &x)
  {
    const Eigen::Index n = L.rows();
    VelocityVector     product(n);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      double sum = 0.;
      for (Eigen::Index k = 0; k <= i; ++k)
        sum += L(i, k) * x[k];
      product[i] = sum;
    }
    return product;
  }

  VelocityVector transposed_lower_times(const VelocityMatrix &L, const VelocityVector &x)
  {
    const Eigen::Index n = L.rows();
    VelocityVector     product(n);
    for (Eigen::Index j = 0; j < n; ++j)
    {
      double sum = 0.;
      for (Eigen::Index i = j; i < n; ++i)
        sum += L(i, j) * x[i];
      product[j] = sum;
    }
    return product;
  }
} // namespace swimtwin
