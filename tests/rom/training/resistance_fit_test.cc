#include <rom/training/resistance_fit.h>

#include <rom/swimmer/dense_algebra.h>
#include <rom/swimmer/resistance_surrogate.h>
#include <rom/training/sampled_shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

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

  // With the same monomials: along a closed way of the shape, at places between those that were sampled.
  TEST_F(ResistanceFitTest, IsCloserWhereAMotionThatIsFavouredGoes)
  {
    const auto on_the_way = [&](const double phase) {
      ShapePoint point = rest;
      point.q << .7e-3 * std::cos(2. * std::numbers::pi * phase), .6e-4 * std::sin(2. * std::numbers::pi * phase);
      return at(point);
    };
    constexpr int                 n = 24;
    std::vector<ResistanceSample> used;
    for (int k = 0; k < n; ++k)
      used.push_back(on_the_way(double(k) / n));
    const auto error = [&](const ResistanceFit &fit) {
      double worst = 0.;
      for (int k = 0; k < n; ++k)
        worst = std::max(worst, fit.velocity_error_at(on_the_way((k + .5) / n), Eigen::VectorXd::Ones(5)));
      return worst;
    };
    const ResistanceFit fit(sampled(40), region, effects);
    ResistanceFit       favouring = fit;
    favouring.favour(used);
    EXPECT_EQ(favouring.resistance().exponents, fit.resistance().exponents);
    EXPECT_LT(error(favouring), .5 * error(fit));
  }

  // Monomials cost time at each step: those that the swimmer's way does not feel are left out.
  TEST_F(ResistanceFitTest, LeavesOutWhatTheSwimmersWayDoesNotFeel)
  {
    for (std::size_t k = 1; k < samples.size(); ++k) // what the best set fits better than smaller ones is scatter
      samples[k].resistance *= 1. + 1e-3 * std::sin(1e3 * static_cast<double>(k));
    const auto ways = [&](const ReducedResistance &r) {
      const ResistanceSurrogate surrogate(r, Eigen::Vector2i(-1, -1));
      Eigen::Matrix2Xd          result(2, 3);
      for (int k = 0; k < 3; ++k)
        result.col(k) = surrogate.resistance((k + 1.) / 5. * region.coordinate_scale_m, 0.).diagonal().head<2>();
      return result;
    };
    const auto fit_with = [&](const FitEconomy &economy) {
      ResistanceFit fit(samples, region, effects, {}, economy);
      EXPECT_EQ(fit.quality().n_features, fit.resistance().exponents.rows());
      EXPECT_EQ(fit.resistance().coefficients.rows(), fit.resistance().exponents.rows());
      return fit;
    };
    const ResistanceFit finest = fit_with({1.});
    const int           most   = finest.quality().n_features;
    EXPECT_EQ(fit_with({1., ways, 1e-11}).quality().n_features, most);
    EXPECT_LT(fit_with({1., ways, 1e-1}).quality().n_features, most);
    // A run that fails is like no other, and what is far worse is no rival, alike or not.
    const auto failing = [](const ReducedResistance &) {
      return Eigen::Matrix2Xd::Constant(2, 3, std::numeric_limits<double>::quiet_NaN());
    };
    EXPECT_EQ(fit_with({1., failing, 1.}).quality().n_features, most);
    const auto          indifferent = [](const ReducedResistance &) { return Eigen::Matrix2Xd::Ones(2, 3); };
    const ResistanceFit coarsest    = fit_with({1., indifferent, 1.});
    EXPECT_LT(coarsest.quality().n_features, most);
    EXPECT_LE(coarsest.quality().rms, no_rival * finest.quality().rms);
  }

  // Off a channel's axis a bend towards the wall is felt more than one away from it.
  TEST_F(ResistanceFitTest, NeedsNoMirror)
  {
    const auto beside_wall = [&](const ShapePoint &point) {
      const Eigen::VectorXd z = region.variables(point);
      Eigen::MatrixXd       S = Eigen::MatrixXd::Identity(5, 5);
      S(1, 1)                 = 1. + .2 * z(0);
      S(0, 1)                 = .1 + .05 * z(1);
      return Eigen::MatrixXd(S * resistance(z) * S.transpose());
    };
    std::vector<ResistanceSample> all{{rest, beside_wall(rest)}};
    for (const auto &point : filling_points(region, rest, 300))
      all.push_back({point, beside_wall(point)});
    EXPECT_GT(ResistanceFit(all, region, effects).quality().rms, 2e-2);

    region.has_mirror = false;
    const ResistanceFit       fit(all, region, effects);
    const ResistanceSurrogate surrogate(fit.resistance(), Eigen::Vector2i(-1, -1));
    EXPECT_LT(fit.quality().largest, 2e-4);
    for (const double sign : {1., -1.})
    {
      ShapePoint point            = rest;
      point.q                     = sign * Eigen::Vector2d(6e-4, 3e-5);
      const Eigen::MatrixXd truth = beside_wall(point);
      EXPECT_LT((surrogate.resistance(point.q, 0.) - truth).norm(), 1e-4 * truth.norm());
    }
    EXPECT_EQ(fit.worst_supported(filling_points(region, rest, 50), 10).size(), 10u);
  }

  TEST_F(ResistanceFitTest, HalvesOfTheSamplesAgreeTheBetterTheMoreThereAre)
  {
    const auto apart = [&](const int n) {
      const ReducedResistance r = ResistanceFit(sampled(n), region, effects).resistance();
      EXPECT_EQ(r.half_fits.size(), 2u);
      return (r.half_fits[0] - r.half_fits[1]).norm() / r.coefficients.norm();
    };
    EXPECT_LT(apart(320), .3 * apart(40));
  }

  // A channel of which the resistance is known: the height above the usual one is felt as it was sampled.
  TEST_F(ResistanceFitTest, HeightBetweenWallsIsThatAboveTheUsualOne)
  {
    const UsualPlace usual{-2e-3, Eigen::Vector2d(.3, -.1)};
    region.depends_on_angle  = true;
    region.angle_scale_rad   = .8;
    region.depends_on_height = true;
    region.height_scale_m    = 4e-4;
    // An odd function of position and shape may come with the even entries only as a product of two.
    const auto in_channel = [&](const ShapePoint &point) {
      const Eigen::VectorXd z = region.variables(point);
      const Eigen::MatrixXd R = resistance(z.head(2));
      return Eigen::MatrixXd(R * (1. + .2 * z(3) * z(3) + .1 * z(3) * z(0) - .05 * z(2) * z(3)));
    };
    std::vector<ResistanceSample> channel{{rest, in_channel(rest)}};
    for (const auto &point : filling_points(region, rest, 900))
      channel.push_back({point, in_channel(point)});
    const ReducedResistance fitted =
        ResistanceFit(channel, region, Eigen::Vector4d(.3, .1, .1, .3), usual).resistance();
    const ResistanceSurrogate surrogate(fitted, Eigen::Vector2i(-1, -1));
    for (const double drift_m : {-2e-4, 0., 3e-4})
    {
      const ShapePoint      point{Eigen::Vector2d(4e-4, -3e-5), .5, 0., drift_m};
      const double          height_m = -2e-3 * std::sin(.5) + .3 * 4e-4 + .1 * 3e-5 + drift_m;
      const Eigen::MatrixXd truth = in_channel(point), R = surrogate.resistance(point.q, point.angle_rad, height_m);
      EXPECT_LT((R - truth).norm(), 2e-3 * truth.norm()) << drift_m;
    }
  }

  // In two corners of the region the tail nearly touches itself, and the resistance is nine times that beside it: no
  // monomials follow that, and they must not try where swimmers are.
  TEST_F(ResistanceFitTest, IsNotSpoiltByCornersThatNoPolynomialFollows)
  {
    const auto cornered = [&](const Eigen::VectorXd &z) {
      Eigen::MatrixXd S = Eigen::MatrixXd::Identity(5, 5);
      S(1, 1) = S(3, 3) = z(0) * z(1) < -.38 ? 3. : 1.;
      return Eigen::MatrixXd(S * resistance(z) * S);
    };
    std::vector<ResistanceSample> all;
    int                           n_in_corners = 0;
    for (const auto &sample : sampled(400))
    {
      const Eigen::VectorXd z = region.variables(sample.point);
      n_in_corners += z(0) * z(1) < -.38;
      all.push_back({sample.point, cornered(z)});
    }
    ASSERT_GT(n_in_corners, 5);
    const ReducedResistance   fitted = ResistanceFit(all, region, Eigen::Vector2d(.5, .4)).resistance();
    const ResistanceSurrogate surrogate(fitted, Eigen::Vector2i(-1, -1));
    double                    worst = 0.;
    for (int k = 0; k < 360; k += 10)
    {
      const double          angle = k * std::numbers::pi / 180.;
      const Eigen::Vector2d z     = .4 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Eigen::MatrixXd R     = surrogate.resistance(z.cwiseProduct(region.coordinate_scale_m), 0.);
      worst                       = std::max(worst, (R - resistance(z)).norm() / resistance(z).norm());
    }
    std::printf("%d of %d samples in corners: off by %.2g with %d monomials\n", n_in_corners,
                static_cast<int>(all.size()), worst, static_cast<int>(fitted.exponents.rows()));
    EXPECT_LT(worst, 5e-3);
  }

  // Runge's function: high degrees fit it best within the samples, and run away beyond them.
  TEST_F(ResistanceFitTest, StaysSoundBeyondTheSamples)
  {
    const auto stiffened = [&](const Eigen::VectorXd &z) {
      Eigen::MatrixXd S = Eigen::MatrixXd::Identity(5, 5);
      S(1, 1)           = std::exp(1. / (1. + 9. * z(0) * z(0)));
      return Eigen::MatrixXd(S * resistance(z) * S);
    };
    std::vector<ResistanceSample> runge;
    for (const auto &sample : sampled(400))
      runge.push_back({sample.point, stiffened(region.variables(sample.point))});
    const ResistanceFit       fit(runge, region, Eigen::Vector2d(.7, .1));
    const ReducedResistance   fitted = fit.resistance();
    const ResistanceSurrogate surrogate(fitted, Eigen::Vector2i(-1, -1));
    const auto                condition = [&](const Eigen::MatrixXd &R) {
      const Eigen::VectorXd values = symmetric_eigenvalues(seen_from(fitted.factor_at_rest, R));
      return values.maxCoeff() / values.minCoeff();
    };
    double in_samples = 1., beyond = 1.;
    for (const auto &sample : runge)
      in_samples = std::max(in_samples, condition(sample.resistance));
    for (int k = 0; k < 360; ++k)
    {
      const double          angle = k * std::numbers::pi / 180.;
      const Eigen::Vector2d q     = 1.5 * Eigen::Vector2d(std::cos(angle) * 1e-3, std::sin(angle) * 1e-4);
      beyond                      = std::max(beyond, condition(surrogate.resistance(q, 0.)));
    }
    EXPECT_LT(beyond, 10. * in_samples);
    EXPECT_LT(fit.quality().rms, 0.028); // the best that is sound without a guide: 0.032
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
