#include <fom/resistance/positive_definite.h>

#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using Matrix = dealii::FullMatrix<double>;

    Matrix matrix(const std::vector<double> &entries)
    {
      const auto n = static_cast<unsigned int>(std::sqrt(static_cast<double>(entries.size())));
      Matrix     R(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          R(i, j) = entries[i * n + j];
      return R;
    }

    std::string refusal(const Matrix &R)
    {
      return message_of<ComputationError>([&] { check_resistance(R, largest_asymmetry(R)); });
    }
  } // namespace

  TEST(ResistanceCheck, PassesWhatIsSymmetricAndPositiveDefiniteInAnyUnits)
  {
    const Matrix R = matrix({20., 1., 1e-4, 1., 30., 2e-3, 1e-4, 2e-3, 1e-6});
    EXPECT_NO_THROW(check_resistance(R, largest_asymmetry(R)));
  }

  TEST(ResistanceCheck, NamesWhatIsWrong)
  {
    expect_in(refusal(matrix({10., -5., -5., -4.8})), "has the diagonal entry 2 = -4.8");
    expect_in(refusal(matrix({1., 2., 2., 1.})), "is not positive definite (scaled to a unit diagonal");
    expect_in(refusal(matrix({1., .1, .2, 1.})), "is asymmetric by 0.1");
    expect_in(refusal(matrix({1., NAN, 0., 1.})), "not finite");
    expect_in(refusal(matrix({NAN, 0., 0., 1.})), "diagonal entry 1");
    expect_in(refusal(matrix({1., 2., 2., 1.})), "refine [numerics] mesh_size_m");
  }

  TEST(ResistanceCheck, AsymmetryOfWhatIsNotANumberIsNone)
  {
    EXPECT_TRUE(std::isnan(largest_asymmetry(matrix({1., NAN, 0., 1.}))));
  }
} // namespace swimtwin
