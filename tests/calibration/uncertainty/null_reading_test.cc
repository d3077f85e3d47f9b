#include <calibration/uncertainty/null_reading.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using enum FittedQuantity;

    /// Information at the truth by exact sensitivities, each integrated for itself.
    Estimate at_truth(const Setting &setting)
    {
      Estimate estimate;
      estimate.error = model_error(reference_model().record, 0., setting.data, Eigen::VectorXd::Ones(setting.data.n()));
      estimate.unknowns = setting.truth();
      ExactDisplacements exact(reference_swimmer(), setting.data.conditions,
                               {.relative_tolerance = 1e-9, .n_threads = 2});
      const Misfit       misfit = misfit_of(setting.input, estimate);
      estimate.prediction       = misfit.predict(exact, estimate.unknowns, true);
      estimate.information      = information(misfit, estimate.unknowns, estimate.prediction);
      return estimate;
    }

    CalibrationProblem with(const std::vector<FreeParameter> &free)
    {
      CalibrationProblem problem;
      problem.free        = free;
      problem.model_error = 0.;
      return problem;
    }

    /// The only null direction, compared with what it must be.
    void expect_null(const Setting &setting, const Eigen::VectorXd &direction, const std::string &word)
    {
      const Estimate estimate = at_truth(setting);
      const auto     nulls    = null_directions(setting.input, estimate);
      ASSERT_EQ(nulls.size(), 1u) << estimate.information.singular_values.transpose();
      const Eigen::VectorXd unit = direction.normalized(), raw = estimate.information.null_directions.col(0);
      EXPECT_LT((raw - raw.dot(unit) * unit).norm(), 1e-4); // as the singular vectors have it
      EXPECT_LT((nulls[0].direction - nulls[0].direction.dot(unit) * unit).norm(), 1e-4);
      EXPECT_NE(nulls[0].reading.find(word), std::string::npos) << nulls[0].reading;
      EXPECT_FALSE(nulls[0].has_prior);
      for (int j = 0; j < setting.map.size(); ++j)
      {
        const bool touched = std::abs(direction[j]) > 0.;
        EXPECT_EQ(estimate.information.touches_undecided(j), touched);
        EXPECT_EQ(curvature_interval(setting.input, estimate, j, 1.96).is_finite(), !touched);
      }
    }

    const FreeParameter E_over_mu = free_parameter(young_modulus_over_viscosity, 1e4, 1e6),
                        M_over_mu = free_parameter(magnetization_over_viscosity, 1e4, 1e6),
                        E = free_parameter(young_modulus, 1e4, 1e6), mu = free_parameter(viscosity, 0.5, 5.),
                        M = free_parameter(magnetization, 5e4, 5e5), field = free_parameter(field_scale, 0.5, 2.),
                        geometry = free_parameter(geometry_scale, 0.5, 2.),
                        scale    = free_parameter(displacement_scale, 0.5, 2.);
  } // namespace

  TEST(NullDirections, StiffnessViscosityAndMagnetizationScaleTogether)
  {
    expect_null(Setting(with({E, mu, M}), {exact_curve(5, known_swimmer())}), Eigen::Vector3d(1., 1., 1.),
                "E, mu and M scale together");
  }

  TEST(NullDirections, TheFieldsScaleActsWithTheMagnetization)
  {
    expect_null(Setting(with({E, M, field}), {exact_curve(5, known_swimmer())}), Eigen::Vector3d(0., 1., -1.),
                "by their product alone");
    expect_null(Setting(with({E_over_mu, M_over_mu, field}), {exact_curve(5, known_swimmer())}),
                Eigen::Vector3d(0., 1., -1.), "by their product alone");
  }

  TEST(NullDirections, AScaledSwimmerLooksLikeScaledDisplacements)
  {
    expect_null(Setting(with({E_over_mu, M_over_mu, geometry, scale}), {exact_curve(6, known_swimmer())}),
                Eigen::Vector4d(0., 0., 1., -1.), "swims farther in proportion");
  }

  TEST(NullDirections, TheViscosityAloneChangesNothingAtGivenRatios)
  {
    expect_null(Setting(with({E_over_mu, M_over_mu, mu}), {exact_curve(5, known_swimmer())}),
                Eigen::Vector3d(0., 0., 1.), "the viscosity alone changes nothing");
  }

  TEST(NullDirections, StiffnessViscosityAndFieldGoTogether)
  {
    expect_null(Setting(with({E, mu, field}), {exact_curve(5, known_swimmer())}), Eigen::Vector3d(1., 1., 1.),
                "E, mu and the field's scale go together");
  }

  TEST(NullDirections, TwoAtOnceAreBothNamed)
  {
    const Setting  setting(with({E, mu, M, field}), {exact_curve(5, known_swimmer())});
    const Estimate estimate = at_truth(setting);
    const auto     nulls    = null_directions(setting.input, estimate);
    ASSERT_EQ(nulls.size(), 2u);
    EXPECT_NE(nulls[0].reading, nulls[1].reading);
    EXPECT_EQ(estimate.information.undecided.cols(), 2);
  }

  TEST(NullDirections, ThereAreNoneWhereOneOfThemIsFixed)
  {
    for (const auto &free : {std::vector{E_over_mu, M_over_mu}, std::vector{E, M}, std::vector{E, mu},
                             std::vector{E_over_mu, M_over_mu, scale}})
    {
      const Setting setting(with(free), {exact_curve(5, known_swimmer())});
      EXPECT_TRUE(null_directions(setting.input, at_truth(setting)).empty());
    }
  }

  TEST(NullDirections, APriorDecidesWhatTheDataCannot)
  {
    FreeParameter known_viscosity = mu;
    known_viscosity.prior         = GaussianPrior{1.52, 0.05 * 1.52};
    const Setting  setting(with({E, known_viscosity, M}), {exact_curve(5, known_swimmer())});
    const Estimate estimate = at_truth(setting);
    const auto     nulls    = null_directions(setting.input, estimate);
    ASSERT_EQ(nulls.size(), 1u);
    EXPECT_TRUE(nulls[0].has_prior);
    EXPECT_EQ(estimate.information.undecided.cols(), 0);
    EXPECT_NEAR(std::sqrt(estimate.information.covariance(1, 1)), 0.05, 1e-4); // the viscosity: the prior alone
    EXPECT_TRUE(curvature_interval(setting.input, estimate, 0, 1.96).is_finite());
  }

  TEST(NullDirections, AFitNamesThemAndClaimsNoInterval)
  {
    CalibrationProblem problem = with({free_parameter(young_modulus, 6e4, 1.05e5), free_parameter(viscosity, 1.4, 1.65),
                                       free_parameter(magnetization, 1.1e5, 1.5e5)});
    problem.n_starts           = 6;
    problem.n_bootstrap_samples = 30;
    const CalibrationResult result =
        calibrate(reference_model(), problem, {noisy_curve(exact_curve(5, known_swimmer()), 1)}, {.n_frequencies = 5});
    EXPECT_EQ(result.status, "undetermined");
    ASSERT_EQ(result.null_directions.size(), 1u);
    EXPECT_LT((result.null_directions[0].direction.cwiseAbs() - Eigen::Vector3d::Constant(1. / std::sqrt(3.))).norm(),
              1e-4);
    for (const char *name : {"young_modulus_Pa", "viscosity_Pa_s", "magnetization_A_m"})
    {
      const CalibratedParameter *p = result.find(name);
      EXPECT_TRUE(p->undetermined);
      EXPECT_FALSE(p->standard_error);
      for (const ClaimedInterval *interval : {&p->curvature, &p->profile, &p->bootstrap})
        EXPECT_TRUE(!interval->low && !interval->high);
    }
    const CalibratedParameter *ratio = result.find("young_modulus_over_viscosity_1_s");
    EXPECT_EQ(ratio->role, ParameterRole::derived);
    EXPECT_TRUE(ratio->curvature.is_finite());
    EXPECT_FALSE(result.next);
    for (const CalibratedSwimmer &swimmer : result.posterior) // a motion is known: its sample scatters by ratios alone
      EXPECT_NEAR(swimmer.young_modulus_Pa * swimmer.viscosity_Pa_s * swimmer.magnetization_A_m,
                  result.swimmer.young_modulus_Pa * result.swimmer.viscosity_Pa_s * result.swimmer.magnetization_A_m,
                  1e-2 * result.swimmer.young_modulus_Pa * result.swimmer.viscosity_Pa_s *
                      result.swimmer.magnetization_A_m);
  }
} // namespace swimtwin
