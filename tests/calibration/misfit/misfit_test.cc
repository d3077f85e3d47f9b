#include <calibration/misfit/misfit.h>
#include <tests/calibration/central_difference.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>

namespace swimtwin
{
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
                                  {.relative_tolerance = 1e-12, .n_threads = 2});
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

  TEST(Misfit, CountsResidualsComponentsAndPriorsOnceEach)
  {
    CalibrationProblem problem = everything_free();
    problem.model_error        = 0.01;
    const Setting         setting(problem, {noisy_curve(exact_curve(4, known_swimmer()), 3)});
    const ModelError      error = model_error(reference_model().record, 0.01, setting.data, Eigen::VectorXd::Ones(4));
    Misfit                misfit(setting.data, setting.map, error, RobustLoss());
    ExactDisplacements    exact(reference_swimmer(), setting.data.conditions, {});
    const Eigen::VectorXd at         = somewhere(setting.map, error.n_components());
    const Prediction      prediction = misfit.predict(exact, at, true);
    const auto            n          = setting.data.n();
    const Eigen::VectorXd r          = (misfit.observed_m - prediction.value_m).cwiseQuotient(misfit.sigma_m);
    const Eigen::VectorXd from_prior = at.head(misfit.n_parameters()) - misfit.prior_means;
    const Eigen::VectorXd z          = at.tail(misfit.n_components());
    const Eigen::MatrixXd P          = misfit.prior_information();
    EXPECT_EQ(misfit.n_rows(), n + misfit.n_components() + 2);
    EXPECT_NEAR(misfit.rows(exact, at, true).misfit(),
                0.5 * (r.squaredNorm() + z.squaredNorm() + from_prior.dot(P * from_prior)), 1e-9 * r.squaredNorm());
    EXPECT_EQ(P.diagonal().count(), 2);
    EXPECT_TRUE(P.isDiagonal());
    // Without the model's error a residual is what its mean leaves; noise twice as large is so for every observation.
    const Eigen::VectorXd mean = misfit.mean_residual(at, prediction);
    EXPECT_TRUE(mean.isApprox(misfit.observed_m - prediction.value_m + prediction.by_error * z, 1e-14));
    const Eigen::MatrixXd more = misfit.covariance(prediction, 2.) - misfit.covariance(prediction, 1.);
    EXPECT_TRUE(more.isApprox(Eigen::MatrixXd((3. * misfit.sigma_m.cwiseAbs2()).asDiagonal()), 1e-12));
  }
} // namespace swimtwin
