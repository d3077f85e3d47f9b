#include <calibration/misfit.h>
#include <tests/calibration/central_difference.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    CalibrationProblem everything_free()
    {
      using enum FittedQuantity;
      CalibrationProblem problem;
      problem.free = {
          free_parameter(young_modulus_over_viscosity, 1e4, 1e6), free_parameter(viscosity, 1., 2.),
          free_parameter(magnetization, 5e4, 3e5, false),         free_parameter(field_scale, 0.5, 2.),
          free_parameter(geometry_scale, 0.5, 2., false),         free_parameter(displacement_scale, 0.5, 2.),
          free_parameter(displacement_offset, -1e-4, 1e-4, false)};
      problem.free[1].prior = GaussianPrior{1.5, 0.1};
      problem.free[6].prior = GaussianPrior{1e-6, 1e-5};
      return problem;
    }

    Eigen::VectorXd somewhere(const ParameterMap &map, const int n_components)
    {
      Eigen::VectorXd unknowns(map.size() + n_components);
      const double    values[] = {5.5e4, 1.45, 1.25e5, 1.04, 0.97, 1.02, 2e-6};
      for (int j = 0; j < map.size(); ++j)
        unknowns[j] = map.scaled(j, values[j]);
      unknowns.tail(n_components).setLinSpaced(-0.6, 0.8);
      return unknowns;
    }
  } // namespace

  TEST(Misfit, GradientAgreesWithCentralDifferences)
  {
    for (const LossKind kind : {LossKind::least_squares, LossKind::cauchy})
    {
      CalibrationProblem problem = everything_free();
      problem.loss               = kind;
      problem.model_error        = 0.01;
      const Setting         setting(problem, {noisy_curve(exact_curve(4, known_swimmer()), 3)});
      const ModelError      error = model_error(reference_model().record, 0.01, setting.data, Eigen::VectorXd::Ones(4));
      const Misfit          misfit(setting.data, setting.map, error, RobustLoss(kind));
      ExactDisplacements    exact(reference_swimmer(), setting.data.conditions,
                                  {.relative_tolerance = 1e-11, .n_threads = 2});
      const Eigen::VectorXd at       = somewhere(setting.map, error.n_components());
      const MisfitRows      rows     = misfit.rows(exact, at, true);
      const Eigen::VectorXd gradient = rows.by_unknowns.transpose() * rows.rows;
      const auto            value    = [&](const int j, const double step) {
        Eigen::VectorXd u = at;
        u[j] += step;
        return misfit.rows(exact, u, false).misfit();
      };
      for (int j = 0; j < misfit.n_unknowns(); ++j)
      {
        const double h          = 0.1 / rows.by_unknowns.col(j).cwiseAbs().maxCoeff(); // a tenth of a sigma
        const double difference = central_difference([&](const double step) { return value(j, step); }, h);
        EXPECT_NEAR(difference, gradient[j], 1e-6 * gradient.cwiseAbs().maxCoeff()) << j;
      }
    }
  }

  TEST(RobustLoss, SlopesAreDerivativesAndSmallResidualsCountAsSquares)
  {
    for (const LossKind kind : {LossKind::least_squares, LossKind::huber, LossKind::pseudo_huber, LossKind::cauchy})
    {
      const RobustLoss loss(kind, 1.5);
      for (const double r : {-7., -1.2, -0.3, 0.01, 0.9, 3., 40.})
      {
        const double h = 1e-5 * std::abs(r);
        EXPECT_NEAR((loss.value(r + h) - loss.value(r - h)) / (2. * h), loss.slope(r), 1e-7 * std::abs(r));
        EXPECT_NEAR((loss.root(r + h) - loss.root(r - h)) / (2. * h), loss.root_slope(r), 1e-7);
        EXPECT_NEAR(0.5 * std::pow(loss.root(r), 2), loss.value(r), 1e-12 * loss.value(r));
        EXPECT_LE(loss.value(r), 0.5 * r * r * (1. + 1e-12));
      }
      EXPECT_NEAR(loss.value(1e-3), 0.5e-6, 1e-11);
      EXPECT_NEAR(loss.root_slope(0.), 1., 1e-6);
    }
  }

  TEST(ModelError, IsOfTheHeldOutSizeAndHalfCommon)
  {
    const Setting    setting(two_ratios(), {exact_curve(6, known_swimmer())});
    const ModelError error = model_error(reference_model().record, {}, setting.data, Eigen::VectorXd::Ones(6));
    EXPECT_EQ(error.origin, "held-out runs");
    EXPECT_NEAR(error.relative_size, 0.0078, 3e-4); // root mean square of the shipped model's six runs
    const Eigen::MatrixXd covariance = error.factor * error.factor.transpose();
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(covariance(i, i), std::pow(error.relative_size, 2), 1e-3 * std::pow(error.relative_size, 2));
    EXPECT_NEAR(covariance(0, 5) / covariance(0, 0),
                0.5 + 0.5 * std::exp(-0.5 * std::pow(std::log10(2. / 0.12) / 0.5, 2)), 2e-3);
  }

  TEST(ParameterMap, SlopesAreDerivatives)
  {
    const Setting         setting(everything_free(), {exact_curve(4, known_swimmer())});
    const ParameterMap   &map        = setting.map;
    const Eigen::VectorXd x          = somewhere(map, 0);
    const auto            quantities = [&](const Eigen::VectorXd &at) {
      const CalibratedSwimmer s = map.swimmer(at);
      Eigen::VectorXd         q(static_cast<Eigen::Index>(n_recording_quantities));
      q << std::log(s.young_modulus_Pa), std::log(s.viscosity_Pa_s), std::log(s.magnetization_A_m),
          std::log(s.field_scale), std::log(s.geometry_scale), std::log(s.displacement_scale), s.displacement_offset_m;
      return q;
    };
    for (int j = 0; j < map.size(); ++j)
    {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(map.size(), j);
      EXPECT_LT(((quantities(x + step) - quantities(x - step)) / 2e-5 - map.slopes(x).col(j)).cwiseAbs().maxCoeff(),
                1e-8);
      EXPECT_NEAR(map.scaled(j, map.value(j, x[j])), x[j], 1e-12);
    }
  }

  TEST(ParameterMap, AGivenRatioFollowsTheViscosity)
  {
    CalibrationProblem problem;
    problem.free  = {free_parameter(FittedQuantity::viscosity, 1., 2.)};
    problem.given = {{FittedQuantity::young_modulus_over_viscosity, 5e4}};
    const ParameterMap    map(problem, reference_swimmer().nominal, 1e-4);
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, std::log(1.3));
    EXPECT_NEAR(map.swimmer(x).young_modulus_Pa, 6.5e4, 1e-8);
    EXPECT_EQ(map.slopes(x)(by_young_modulus, 0), 1.);
  }
} // namespace swimtwin
