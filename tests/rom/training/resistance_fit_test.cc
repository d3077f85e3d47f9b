#include <rom/training/resistance_fit.h>

#include <rom/training/sampled_shapes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// A made-up swimmer of two bending coordinates whose resistance has the mirror's symmetry exactly.
    Eigen::MatrixXd resistance(const Eigen::VectorXd &z)
    {
      const double    c = std::cos(.6 * z(0) + .2 * z(1)), s = std::sin(.6 * z(0) - .1 * z(1));
      Eigen::MatrixXd L = Eigen::MatrixXd::Zero(5, 5);
      L.diagonal() << 2. + .3 * c, 3. - .2 * s * s, 1.5 + .1 * c, 1. + .2 * s * s, 1.2;
      L(1, 0) = .4 * s;
      L(2, 0) = -.3 * s;
      L(2, 1) = .5 + .1 * c;
      L(3, 0) = .2 * s;
      L(3, 1) = .3;
      L(3, 2) = .1 * c;
      L(4, 3) = .2;
      return L * L.transpose();
    }

    class ResistanceFitTest : public ::testing::Test
    {
    protected:
      SampledRegion                 region{Eigen::Vector2d(1e-3, 1e-4), false, 1.};
      ShapePoint                    rest{Eigen::VectorXd::Zero(2), 0., 0., 0.};
      std::vector<ResistanceSample> samples = sampled(160);
      Eigen::VectorXd               effects = Eigen::Vector2d(.3, .1);

      ResistanceSample at(const ShapePoint &point) const { return {point, resistance(region.variables(point))}; }
      std::vector<ResistanceSample> sampled(const int n) const
      {
        std::vector<ResistanceSample> all{at(rest)};
        for (const auto &point : filling_points(region, rest, n))
          all.push_back(at(point));
        return all;
      }
    };
  } // namespace

  TEST_F(ResistanceFitTest, ReproducesASmoothResistance)
  {
    const ResistanceFit fit(samples, region, effects);
    EXPECT_LT(fit.quality().largest, 1e-4);
  }

  TEST_F(ResistanceFitTest, MoreSamplesAllowAFinerFit)
  {
    const ResistanceFit coarse(sampled(40), region, effects), fine(sampled(320), region, effects);
    EXPECT_LT(fine.quality().rms, .2 * coarse.quality().rms);
  }

  TEST_F(ResistanceFitTest, CoefficientsHaveTheMirrorsParity)
  {
    const ReducedResistance r = ResistanceFit(samples, region, effects).resistance();
    for (Eigen::Index f = 0; f < r.exponents.rows(); ++f)
      for (int i = 0, k = 0; i < 5; ++i)
        for (int j = 0; j <= i; ++j, ++k)
        {
          const bool odd_monomial = r.exponents.row(f).sum() % 2 == 1,
                     odd_entry    = velocity_parity(i) * velocity_parity(j) < 0;
          EXPECT_TRUE(odd_monomial == odd_entry || r.coefficients(f, k) == 0.);
        }
  }

  TEST_F(ResistanceFitTest, LeverageGrowsAwayFromTheSamples)
  {
    const ResistanceFit fit(samples, region, effects);
    ShapePoint          inside = rest, outside = rest;
    inside.q  = Eigen::Vector2d(3e-4, 2e-5);
    outside.q = Eigen::Vector2d(1.5e-3, 0.);
    EXPECT_LT(fit.leverage(inside), 1.);
    EXPECT_GT(fit.leverage(outside), 10. * fit.leverage(inside));
  }
} // namespace swimtwin
