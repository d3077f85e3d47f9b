#include <calibration/fit/search_misfit.h>
#include <datasets/system/error.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>
#include <limits>
#include <map>

namespace swimtwin
{
  namespace
  {
    double deviation(const Estimate &estimate, const int j)
    {
      return std::sqrt(estimate.information.covariance(j, j));
    }

    /// Bounds far beyond the truth, where displacements are rough and outliers lead.
    CalibrationProblem far_bounds(const LossKind loss)
    {
      CalibrationProblem problem = two_ratios();
      problem.free               = {free_parameter(FittedQuantity::young_modulus_over_viscosity, 2e4, 4e5),
                                    free_parameter(FittedQuantity::magnetization_over_viscosity, 6e4, 3e5)};
      problem.n_starts           = 4;
      problem.loss               = loss;
      return problem;
    }

    struct GridPoint
    {
      Eigen::VectorXd x;
      Displacements   displacements;
    };

    /// Runs at n x n points of the bounds; they depend on the conditions alone, not on what was observed.
    std::vector<GridPoint> runs_on_grid(const FitInput &input, const int n)
    {
      ExactDisplacements     exact(input.model, input.data.conditions, {.n_threads = 2, .by = {}});
      const Eigen::VectorXd  lower = input.map.lower(), width = input.map.upper() - lower;
      std::vector<GridPoint> grid;
      for (int i = 0; i < n * n; ++i)
      {
        const Eigen::Array2d  share(i % n / (n - 1.), i / n / (n - 1.));
        const Eigen::VectorXd x = lower + (share * width.array()).matrix();
        grid.push_back({x, exact.evaluate(input.map.swimmer(x), false)});
      }
      return grid;
    }

    double least_misfit(const FitInput &input, const Estimate &estimate, const std::vector<GridPoint> &grid)
    {
      const Misfit       misfit = misfit_of(input, estimate);
      const SearchMisfit search(misfit);
      double             least = std::numeric_limits<double>::max();
      for (const GridPoint &point : grid)
      {
        KnownDisplacements known(point.displacements);
        least = std::min(least, misfit.rows(known, search.unknowns(point.displacements, point.x), false).misfit());
      }
      return least;
    }
  } // namespace

  TEST(Fit, FindsTheSwimmerBehindExactData)
  {
    const Setting  setting(two_ratios(), {exact_curve(6, known_swimmer())});
    const Estimate estimate = fit(setting.input);
    EXPECT_TRUE(estimate.polished);
    EXPECT_LT((estimate.x() - setting.truth()).cwiseAbs().maxCoeff(), 2e-4);
    EXPECT_LT(estimate.misfit, 1e-4);
    EXPECT_EQ(estimate.search.minima.size(), 8u);
    for (const Minimum &minimum : estimate.search.minima)
      EXPECT_EQ(minimum.status, MinimumStatus::converged) << minimum.message;
    EXPECT_TRUE(estimate.refined.converged());
  }

  TEST(Fit, NearAStartAgreesWithTheWholeSearch)
  {
    const Setting  setting(two_ratios(), {noisy_curve(exact_curve(6, known_swimmer()), 7)});
    const Estimate whole = fit(setting.input), near = setting.estimate();
    EXPECT_TRUE(whole.polished);
    EXPECT_TRUE(near.polished);
    EXPECT_LT(whole.kkt_residual, 1e-3);
    EXPECT_LT((whole.x() - near.x()).cwiseAbs().maxCoeff(), 0.02 * deviation(whole, 0));
    EXPECT_NEAR(whole.misfit, near.misfit, 1e-3);
  }

  TEST(Fit, AnOutlierOfTenSigmaMovesTheRobustEstimateByLessThanOneSigma)
  {
    const ObservationSet clean   = noisy_curve(exact_curve(12, known_swimmer()), 2);
    ObservationSet       spoiled = clean;
    spoiled.points[5].displacement_m += 10. * spoiled.points[5].sigma_m;
    for (const LossKind kind : {LossKind::huber, LossKind::pseudo_huber, LossKind::cauchy})
    {
      CalibrationProblem problem = two_ratios();
      problem.loss               = kind;
      const Setting  of_clean(problem, {clean}), of_spoiled(problem, {spoiled});
      const Estimate before = of_clean.estimate(), after = of_spoiled.estimate();
      for (int j = 0; j < 2; ++j)
        EXPECT_LT(std::abs(after.x()[j] - before.x()[j]), deviation(before, j)) << to_string(kind) << " " << j;
    }
    const Setting         of_clean(two_ratios(), {clean}), of_spoiled(two_ratios(), {spoiled});
    const Estimate        before = of_clean.estimate();
    const Eigen::VectorXd moved  = of_spoiled.estimate().x() - before.x();
    EXPECT_GT((before.information.whitened * moved).norm(), 1.); // least squares is moved by more
  }

  TEST(Fit, BesideOutliersNoRunOfAGridHasALowerMisfit)
  {
    struct Spoiled
    {
      std::map<std::size_t, double> factors; ///< by observation
      LossKind                      loss  = LossKind::least_squares;
      double                        error = 0.;
    };
    const ObservationSet         clean = noisy_curve(exact_curve(5, known_swimmer()), 1);
    const std::vector<GridPoint> grid  = runs_on_grid(Setting(far_bounds(LossKind::least_squares), {clean}).input, 9);
    for (const auto &[factors, loss, error] : {Spoiled{{{2, 10.}}, LossKind::least_squares, 0.008},
                                               Spoiled{{{0, 8.}, {3, 0.1}}}, Spoiled{{{2, 10.}}, LossKind::huber}})
    {
      ObservationSet set = clean;
      for (const auto &[i, factor] : factors)
        set.points[i].displacement_m *= factor;
      CalibrationProblem problem = far_bounds(loss);
      problem.model_error        = error;
      const Setting  setting(problem, {set});
      const Estimate estimate = fit(setting.input);
      EXPECT_TRUE(estimate.polished) << estimate.polish_step;
      EXPECT_LE(estimate.misfit, least_misfit(setting.input, estimate, grid)) << factors.begin()->first;
    }
  }

  TEST(Fit, TheModelsErrorMakesTheEstimateLessSureAndTakesUpACommonFactor)
  {
    ObservationSet set = exact_curve(6, known_swimmer());
    for (Observation &point : set.points)
    {
      point.displacement_m *= 1.01;
      point.sigma_m *= 0.05; // 0.1 %
    }
    CalibrationProblem problem = two_ratios();
    const Setting      without(problem, {set});
    problem.model_error = 0.01;
    const Setting  with(problem, {set});
    const Estimate sure = without.estimate(), unsure = with.estimate();
    EXPECT_GT(deviation(unsure, 0), 3. * deviation(sure, 0));
    EXPECT_LT(std::abs(unsure.x()[0] - with.truth()[0]), 2. * deviation(unsure, 0));
    EXPECT_GT(std::abs(sure.x()[0] - with.truth()[0]), 3. * deviation(sure, 0)); // wrong, and sure of it
    EXPECT_LT(unsure.misfit, sure.misfit);
  }

  TEST(Fit, APriorPullsByItsSize)
  {
    const ObservationSet set     = exact_curve(6, known_swimmer());
    CalibrationProblem   problem = two_ratios();
    const Setting        plain(problem, {set});
    const Estimate       free  = plain.estimate();
    const double         shift = deviation(free, 0); // one standard deviation of the data away, as sure as they are
    const double         mean  = std::exp(free.x()[0] + shift);
    const double         alone = std::sqrt(1. / free.information.covariance.inverse()(0, 0));
    problem.free[0].prior      = GaussianPrior{mean, alone * mean};
    const Setting         pulled(problem, {set});
    const Estimate        estimate = pulled.estimate();
    const Eigen::Matrix2d F        = free.information.covariance.inverse();
    Eigen::Matrix2d       with     = F;
    with(0, 0) += 1. / (alone * alone);
    const Eigen::Vector2d expected = with.inverse() * Eigen::Vector2d(shift / (alone * alone), 0.);
    EXPECT_LT((estimate.x() - free.x() - expected).norm(), 0.03 * expected.norm());
    EXPECT_NEAR(deviation(estimate, 0), std::sqrt(with.inverse()(0, 0)), 0.02 * deviation(estimate, 0));
  }

  TEST(Fit, ScaleAndOffsetOfTheRecordingAreFound)
  {
    CalibratedSwimmer swimmer     = known_swimmer();
    swimmer.displacement_scale    = 1.08;
    swimmer.displacement_offset_m = 3e-6;
    CalibrationProblem problem    = two_ratios();
    problem.free.push_back(free_parameter(FittedQuantity::displacement_scale, 0.5, 2.));
    problem.free.push_back(free_parameter(FittedQuantity::displacement_offset, -2e-5, 2e-5, false));
    const Setting  setting(problem, {exact_curve(8, swimmer)});
    const Estimate estimate = setting.estimate();
    EXPECT_NEAR(setting.map.value(2, estimate.x()[2]), 1.08, 2e-3);
    EXPECT_NEAR(setting.map.value(3, estimate.x()[3]), 3e-6, 2e-8);
  }

  TEST(Fit, PeriodicMotionAndTwoFieldsAreFittedTogether)
  {
    ObservationSet third = exact_curve(3, known_swimmer()), periodic = exact_curve(3, known_swimmer(), std::nullopt);
    const Setting  setting(two_ratios(), {third, periodic});
    const Estimate estimate = fit(setting.input);
    EXPECT_TRUE(estimate.polished);
    EXPECT_LT((estimate.x() - setting.truth()).cwiseAbs().maxCoeff(), 5e-4);
  }
} // namespace swimtwin
