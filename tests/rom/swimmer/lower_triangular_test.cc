#include <rom/swimmer/lower_triangular.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double rounding = 1e-13;

    class LowerTriangular : public testing::TestWithParam<int>
    {
    protected:
      void SetUp() override
      {
        std::srand(5);
        for (VelocityMatrix *matrix : {&A_, &B_})
        {
          matrix->triangularView<Eigen::StrictlyUpper>().setConstant(std::nan("")); // not looked at
          matrix->diagonal().array() += 3.;
        }
      }

      static VelocityMatrix whole(const VelocityMatrix &L) { return L.triangularView<Eigen::Lower>(); }

      const int      n_ = GetParam();
      VelocityMatrix A_ = VelocityMatrix::Random(n_, n_), B_ = VelocityMatrix::Random(n_, n_);
      VelocityVector x_ = VelocityVector::Random(n_);
    };

    TEST_P(LowerTriangular, ProductsAreThoseOfWholeMatrices)
    {
      VelocityMatrix product = VelocityMatrix::Constant(n_, n_, 7.), sum = VelocityMatrix::Ones(n_, n_);
      set_lower_product(A_, B_, product);
      add_lower_square(2., A_, sum);
      EXPECT_LE((product - whole(A_) * whole(B_)).norm(), rounding * product.norm());
      const VelocityMatrix expected = VelocityMatrix::Ones(n_, n_) + 2. * whole(A_) * whole(A_).transpose();
      EXPECT_LE((whole(sum) - whole(expected)).norm(), rounding * expected.norm());
      EXPECT_LE((lower_times(A_, x_) - whole(A_) * x_).norm(), rounding * A_.rows() * x_.norm());
      EXPECT_LE((transposed_lower_times(A_, x_) - whole(A_).transpose() * x_).norm(), rounding * A_.rows() * x_.norm());
    }

    INSTANTIATE_TEST_SUITE_P(Sizes, LowerTriangular, testing::Values(1, 4, 7, max_velocities));
  } // namespace
} // namespace swimtwin
