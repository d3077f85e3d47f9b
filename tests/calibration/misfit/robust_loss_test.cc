#include <calibration/misfit/robust_loss.h>
#include <tests/calibration/central_difference.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    const LossKind kinds[]     = {LossKind::least_squares, LossKind::huber, LossKind::pseudo_huber, LossKind::cauchy};
    const double   residuals[] = {-7., -1.2, -0.3, 0.01, 0.9, 3., 40.};
  } // namespace

  TEST(RobustLoss, SlopesAreDerivatives)
  {
    for (const LossKind kind : kinds)
    {
      const RobustLoss loss(kind, 1.5);
      for (const double r : residuals)
      {
        const double h = 1e-2 * std::abs(r); // far enough from Huber's kinks at 1.5
        EXPECT_NEAR(central_difference([&](const double d) { return loss.value(r + d); }, h), loss.slope(r),
                    1e-9 * std::abs(r))
            << to_string(kind) << " " << r;
        EXPECT_NEAR(central_difference([&](const double d) { return loss.root(r + d); }, h), loss.root_slope(r), 1e-8)
            << to_string(kind) << " " << r;
      }
    }
  }

  TEST(RobustLoss, HalfTheSquareOfTheRootIsTheLoss)
  {
    for (const LossKind kind : kinds)
      for (const double r : residuals)
      {
        const RobustLoss loss(kind, 1.5);
        EXPECT_NEAR(0.5 * std::pow(loss.root(r), 2), loss.value(r), 1e-14 * loss.value(r));
        EXPECT_EQ(std::signbit(loss.root(r)), std::signbit(r));
        EXPECT_EQ(loss.slope(r), loss.weight(r) * r);
      }
  }

  TEST(RobustLoss, SmallResidualsCountAsSquaresAndLargeOnesLess)
  {
    for (const LossKind kind : kinds)
    {
      const RobustLoss loss(kind, 1.5);
      EXPECT_NEAR(loss.value(1e-3), 0.5e-6, 1e-12); // the next order is r^4 / w^2
      EXPECT_NEAR(loss.root_slope(0.), 1., 1e-12);
      double weight = 1.;
      for (double r = 0.; r < 50.; r += 0.1)
      {
        EXPECT_EQ(loss.value(-r), loss.value(r));
        EXPECT_LE(loss.value(r), 0.5 * r * r * (1. + 1e-12));
        EXPECT_LE(loss.weight(r), weight * (1. + 1e-15));
        weight = loss.weight(r);
      }
      EXPECT_EQ(loss.is_robust(), weight < 1.);
    }
  }

  TEST(RobustLoss, FarResidualsPullWithABoundedForce)
  {
    const double w = 1.5, far = 1e6;
    EXPECT_NEAR(RobustLoss(LossKind::huber, w).slope(far), w, 1e-12);
    EXPECT_NEAR(RobustLoss(LossKind::pseudo_huber, w).slope(far), w, 1e-9);
    EXPECT_NEAR(RobustLoss(LossKind::cauchy, w).slope(far), w * w / far, 1e-9); // and less the farther
  }

  TEST(RobustLoss, AWideOneIsLeastSquares)
  {
    for (const LossKind kind : kinds)
      for (const double r : residuals)
        EXPECT_NEAR(RobustLoss(kind, 1e6).value(r), 0.5 * r * r, 1e-9 * r * r);
  }
} // namespace swimtwin
