#include <calibration/fit/bounds_search.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    Minimum minimum(const double x, const double objective, const MinimumStatus status = MinimumStatus::converged)
    {
      Minimum minimum;
      minimum.status    = status;
      minimum.x         = Eigen::Vector2d(x, 0.);
      minimum.objective = objective;
      return minimum;
    }
  } // namespace

  TEST(BoundsSearch, FollowsMinimaThatDifferAndMayBeTheBest)
  {
    Multistart search;
    search.minima       = {minimum(0.5, 3.), minimum(0.505, 2.), minimum(0.9, 40.), minimum(0.1, 5.),
                           minimum(0.2, 0., MinimumStatus::failed)};
    search.best         = 1;
    const auto distinct = distinct_minima(search, Eigen::Vector2d(1., 1.));
    ASSERT_EQ(distinct.size(), 2u);
    EXPECT_EQ(distinct[0][0], 0.505); // the better one of a pair
    EXPECT_EQ(distinct[1][0], 0.1);
  }

  TEST(BoundsSearch, FollowsFewMinima)
  {
    Multistart search;
    search.best = 0;
    for (int i = 0; i < 10; ++i)
      search.minima.push_back(minimum(0.1 * i, 1. + i));
    EXPECT_EQ(distinct_minima(search, Eigen::Vector2d(1., 1.)).size(), 3u);
  }

  TEST(BoundsSearch, StartsWhereTheProblemSaysOrAtTheNominalSwimmer)
  {
    CalibrationProblem problem = two_ratios();
    problem.n_starts           = 3;
    problem.free[0].start      = 4e4;
    const Setting    setting(problem, {exact_curve(3, known_swimmer())});
    const ModelError none   = model_error({}, {}, setting.data, Eigen::VectorXd::Ones(3));
    const auto       search = search_bounds(setting.input, none);
    ASSERT_EQ(search.starts.cols(), 3);
    EXPECT_NEAR(search.starts(0, 0), std::log(4e4), 1e-14);
    EXPECT_EQ(search.starts(1, 0), setting.map.nominal()[1]);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_TRUE((search.starts.col(i).array() >= setting.map.lower().array()).all());
      EXPECT_TRUE((search.starts.col(i).array() <= setting.map.upper().array()).all());
    }
    EXPECT_GT(search.n_runs, 0);
    ASSERT_NE(search.table, nullptr);
    EXPECT_LT(search.table->interpolation_error(), 1e-2);
    EXPECT_LT((search.minima[static_cast<std::size_t>(search.best)].x - setting.truth()).cwiseAbs().maxCoeff(), 0.05);
  }

  TEST(Waterfall, PutsTheLowestMisfitFirstAndWhatFailedLast)
  {
    const Setting setting(two_ratios(), {exact_curve(3, known_swimmer())});
    BoundsSearch  search;
    search.starts     = Eigen::MatrixXd::Constant(2, 3, std::log(5e4));
    search.minima     = {minimum(11., 7., MinimumStatus::failed), minimum(10.8, 4.), minimum(10.9, 2.)};
    search.best       = 2;
    const auto starts = waterfall(setting.input, search);
    ASSERT_EQ(starts.size(), 3u);
    EXPECT_EQ(starts[0].misfit, 2.);
    EXPECT_EQ(starts[1].misfit, 4.);
    EXPECT_TRUE(std::isnan(starts[2].misfit));
    EXPECT_NEAR(starts[0].start[0], 5e4, 1e-8);
    EXPECT_NEAR(starts[0].end[0], std::exp(10.9), 1e-8);
  }
} // namespace swimtwin
