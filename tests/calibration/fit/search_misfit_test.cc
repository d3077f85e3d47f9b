#include <calibration/fit/search_misfit.h>
#include <rom/swimmer/dense_algebra.h>
#include <tests/calibration/central_difference.h>
#include <tests/calibration/synthetic_curve.h>

namespace swimtwin
{
  namespace
  {
    /// A curve with an outlier, the model's error of 1 %, and a loss.
    struct Case
    {
      explicit Case(const LossKind kind)
          : setting(two_ratios(), {spoiled()}),
            error(model_error(reference_model().record, 0.01, setting.data, Eigen::VectorXd::Ones(6))),
            misfit(setting.data, setting.map, error, RobustLoss(kind)), table(setting.table())
      {
      }

      static ObservationSet spoiled()
      {
        ObservationSet set = noisy_curve(exact_curve(6, known_swimmer()), 3);
        set.points[2].displacement_m *= 3.;
        return set;
      }

      Setting                            setting;
      ModelError                         error;
      Misfit                             misfit;
      std::shared_ptr<DisplacementTable> table;
    };
  } // namespace

  TEST(SearchMisfit, IsLeastOverTheModelsError)
  {
    for (const LossKind kind : {LossKind::least_squares, LossKind::huber, LossKind::pseudo_huber, LossKind::cauchy})
    {
      const Case            at(kind);
      const Eigen::VectorXd x = at.setting.truth();
      const Eigen::VectorXd unknowns =
          SearchMisfit(at.misfit).unknowns(at.table->evaluate(at.setting.map.swimmer(x), false), x);
      const MisfitRows      rows  = at.misfit.rows(*at.table, unknowns, true);
      const Eigen::VectorXd slope = rows.by_unknowns.transpose() * rows.rows;
      EXPECT_EQ(unknowns.head(2), x);
      EXPECT_LT(slope.tail(at.error.n_components()).norm(), 1e-6 * rows.rows.norm()) << to_string(kind);
      EXPECT_GT(unknowns.tail(at.error.n_components()).norm(), 0.1) << to_string(kind);
    }
  }

  TEST(SearchMisfit, OfLeastSquaresCountsTheModelsErrorAsCovariance)
  {
    const Case            at(LossKind::least_squares);
    const Eigen::VectorXd x = at.setting.truth();
    Evaluation            evaluation;
    SearchMisfit(at.misfit).minimization_problem(at.table).evaluate(x, false, evaluation);
    Eigen::VectorXd without_error    = Eigen::VectorXd::Zero(at.misfit.n_unknowns());
    without_error.head(2)            = x;
    const Prediction      prediction = at.misfit.predict(*at.table, without_error, true);
    const Eigen::VectorXd r          = at.misfit.mean_residual(without_error, prediction);
    const Eigen::MatrixXd V          = at.misfit.covariance(prediction, 1.);
    EXPECT_NEAR(evaluation.objective, 0.5 * r.dot(solve_symmetric<Eigen::VectorXd>(V, r)),
                1e-10 * evaluation.objective);
  }

  TEST(SearchMisfit, GradientAgreesWithCentralDifferences)
  {
    for (const LossKind kind : {LossKind::least_squares, LossKind::pseudo_huber})
    {
      const Case                at(kind);
      const SearchMisfit        search(at.misfit);
      const MinimizationProblem problem = search.minimization_problem(at.table);
      const Eigen::VectorXd     x       = at.setting.truth();
      Evaluation                evaluation;
      problem.evaluate(x, true, evaluation);
      for (int j = 0; j < 2; ++j)
      {
        const auto value = [&](const double step) {
          Evaluation beside;
          problem.evaluate(x + step * Eigen::VectorXd::Unit(2, j), false, beside);
          return beside.objective;
        };
        EXPECT_NEAR(central_difference(value, 1e-3), evaluation.gradient[j], 1e-5 * evaluation.gradient.norm());
      }
    }
  }
} // namespace swimtwin
