#include <datasets/system/error.h>
#include <optimization/guarded_search.h>

#include <tests/optimization/known_problems.h>

#include <gtest/gtest.h>

#include <limits>

namespace swimtwin
{
  namespace
  {
    const Eigen::Vector2d tutorial_start(1.234, 5.678);

    std::vector<SearchMethod> methods_with(const bool constraints)
    {
      std::vector<SearchMethod> methods;
      for (const SearchMethod method : all_search_methods())
        if (!constraints || takes_constraints(method))
          methods.push_back(method);
      return methods;
    }

    SearchOptions options_for(const SearchMethod method)
    {
      SearchOptions options;
      options.method          = method;
      options.max_evaluations = 20000;
      return options;
    }

    /// Never success with a wrong point; an honest status and a feasible point otherwise.
    void expect_right_or_honest(const Minimum &minimum, const double unit, const std::string &method)
    {
      SCOPED_TRACE(method + ": " + to_string(minimum.status) + ", " + minimum.message);
      if (minimum.converged())
      {
        EXPECT_NEAR(minimum.objective / unit, 0.544331, 1e-4);
      }
      EXPECT_TRUE(minimum.is_feasible());
    }

    class ConstrainedSearch : public testing::TestWithParam<SearchMethod>
    {
    };
    class Search : public testing::TestWithParam<SearchMethod>
    {
    };

    std::string name_of(const testing::TestParamInfo<SearchMethod> &method)
    {
      std::string name = to_string(method.param);
      std::erase(name, '-');
      return name;
    }

    INSTANTIATE_TEST_SUITE_P(Methods, ConstrainedSearch, testing::ValuesIn(methods_with(true)), name_of);
    INSTANTIATE_TEST_SUITE_P(Methods, Search, testing::ValuesIn(methods_with(false)), name_of);

    TEST_P(ConstrainedSearch, TutorialIsSolvedOrTheFailureIsSaid)
    {
      const Minimum minimum = search_minimum(tutorial_problem(), tutorial_start, options_for(GetParam()));
      expect_right_or_honest(minimum, 1., to_string(GetParam()));
    }

    TEST_P(ConstrainedSearch, BadlyScaledTutorialIsSolvedOrTheFailureIsSaid)
    {
      const Eigen::Vector2d start(1.234e-6, 5.678e7);
      const Minimum         minimum = search_minimum(tutorial_problem(1e-6, 1e7, 1e-9), start, options_for(GetParam()));
      expect_right_or_honest(minimum, 1e-9, to_string(GetParam()));
    }

    TEST_P(Search, ValleyIsFollowedToItsEnd)
    {
      const Minimum minimum = search_minimum(rosenbrock_problem(), Eigen::Vector2d(-1.2, 1.), options_for(GetParam()));
      if (minimum.converged())
      {
        EXPECT_NEAR((minimum.x - Eigen::Vector2d::Ones()).norm(), 0., 0.05) << to_string(GetParam());
      }
      EXPECT_LE(minimum.objective, 0.1) << to_string(GetParam()) << ": " << minimum.message;
    }

    TEST(GuardedSearch, GradientMethodsWithConstraintsSolveTheTutorial)
    {
      for (const SearchMethod method :
           {SearchMethod::mma, SearchMethod::ccsaq, SearchMethod::slsqp, SearchMethod::cobyla})
      {
        const Minimum minimum = search_minimum(tutorial_problem(), tutorial_start, options_for(method));
        EXPECT_TRUE(minimum.converged()) << to_string(method) << ": " << minimum.message;
        EXPECT_NEAR(minimum.objective, 0.544331, 1e-5) << to_string(method);
        EXPECT_NEAR(minimum.x[0], 1. / 3., 1e-3) << to_string(method);
      }
    }

    TEST(GuardedSearch, MultipliersPriceTheConstraints)
    {
      // At (1/3, 8/27) both constraints are active: grad f + sum of multipliers times grad g = 0.
      SearchOptions options          = options_for(SearchMethod::ccsaq);
      options.kkt_tolerance          = 1e-6;
      const Minimum         minimum  = search_minimum(tutorial_problem(), tutorial_start, options);
      const double          slope    = 0.5 / std::sqrt(8. / 27.);
      const Eigen::Vector2d expected = slope * Eigen::Vector2d(1. / 3., 2. / 3.);
      ASSERT_EQ(minimum.multipliers.size(), 2);
      EXPECT_NEAR((minimum.multipliers - expected).norm(), 0., 1e-3);
    }

    TEST(GuardedSearch, BestPointIsTheLastOfTheTraceAndTheTraceFalls)
    {
      const Minimum minimum =
          search_minimum(rosenbrock_problem(), Eigen::Vector2d(-1.2, 1.), options_for(SearchMethod::cobyla));
      ASSERT_FALSE(minimum.trace.empty());
      EXPECT_EQ(minimum.trace.back().objective, minimum.objective);
      for (std::size_t i = 1; i < minimum.trace.size(); ++i)
        EXPECT_LT(minimum.trace[i].objective, minimum.trace[i - 1].objective);
    }

    TEST(GuardedSearch, MinimumOnABoundConverges)
    {
      MinimizationProblem problem = rosenbrock_problem();
      problem.upper[0]            = 0.5; // then x2 = x1^2 at the bound
      const Minimum minimum       = search_minimum(problem, Eigen::Vector2d(-1., 1.), options_for(SearchMethod::lbfgs));
      EXPECT_TRUE(minimum.converged()) << minimum.message;
      EXPECT_NEAR((minimum.x - Eigen::Vector2d(0.5, 0.25)).norm(), 0., 1e-3);
    }

    TEST(GuardedSearch, StartAtTheMinimumConverges)
    {
      const Minimum minimum =
          search_minimum(rosenbrock_problem(), Eigen::Vector2d(1., 1.), options_for(SearchMethod::ccsaq));
      EXPECT_TRUE(minimum.converged()) << minimum.message;
    }

    TEST(GuardedSearch, BudgetIsKeptAndSaid)
    {
      SearchOptions options   = options_for(SearchMethod::ccsaq);
      options.max_evaluations = 5;
      const Minimum minimum   = search_minimum(rosenbrock_problem(), Eigen::Vector2d(-1.2, 1.), options);
      EXPECT_EQ(minimum.status, MinimumStatus::budget_exhausted);
      EXPECT_LE(minimum.n_evaluations, 6); // the last one for the first-order conditions
      EXPECT_NE(minimum.message.find("evaluations were not enough"), std::string::npos) << minimum.message;
    }

    TEST(GuardedSearch, ConstraintThatNothingMeetsIsNamed)
    {
      MinimizationProblem problem = rosenbrock_problem();
      problem.n_constraints       = 1;
      problem.constraint_names    = {"sum of squares"};
      const auto valley           = problem.evaluate;
      problem.evaluate            = [valley](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
        valley(x, derivatives, evaluation);
        evaluation.constraints = Eigen::VectorXd::Constant(1, x.squaredNorm() + 1.);
        evaluation.jacobian    = 2. * x.transpose();
      };
      const Minimum minimum = search_minimum(problem, Eigen::Vector2d(2., 2.), options_for(SearchMethod::ccsaq));
      EXPECT_EQ(minimum.status, MinimumStatus::infeasible);
      EXPECT_NE(minimum.message.find("'sum of squares'"), std::string::npos) << minimum.message;
      EXPECT_FALSE(minimum.is_feasible());
    }

    TEST(GuardedSearch, ViolationsAreMeasuredInTheProblemsOwnScales)
    {
      // Where the search starts the second constraint hardly changes: its scale from there would make a violation of
      // 1e-9 large.
      MinimizationProblem problem;
      problem.lower            = Eigen::Vector2d(-2., -2.);
      problem.upper            = Eigen::Vector2d(2., 2.);
      problem.n_constraints    = 1;
      problem.constraint_scale = Eigen::VectorXd::Ones(1);
      problem.evaluate         = [](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
        evaluation.objective   = -x.sum();
        evaluation.constraints = Eigen::VectorXd::Constant(1, std::pow(x.squaredNorm(), 4) - 1.);
        if (derivatives)
        {
          evaluation.gradient = Eigen::Vector2d(-1., -1.);
          evaluation.jacobian = 8. * std::pow(x.squaredNorm(), 3) * x.transpose();
        }
      };
      const Minimum minimum = search_minimum(problem, Eigen::Vector2d(0.02, 0.01), options_for(SearchMethod::slsqp));
      EXPECT_TRUE(minimum.converged()) << minimum.message;
      EXPECT_NEAR(minimum.objective, -std::sqrt(2.), 1e-4);
    }

    TEST(GuardedSearch, PointsThatCannotBeComputedAreAvoided)
    {
      MinimizationProblem problem = rosenbrock_problem();
      const auto          valley  = problem.evaluate;
      problem.evaluate            = [valley](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
        evaluation.failure = x[1] > 1.5 ? "no motion there" : "";
        valley(x, derivatives, evaluation);
      };
      const Minimum minimum = search_minimum(problem, Eigen::Vector2d(-1.2, 1.), options_for(SearchMethod::ccsaq));
      EXPECT_TRUE(minimum.converged()) << minimum.message;
    }

    TEST(GuardedSearch, ProblemThatCannotBeComputedFailsWithItsReason)
    {
      MinimizationProblem problem = rosenbrock_problem();
      problem.evaluate            = [](const Eigen::VectorXd &, bool, Evaluation &evaluation) {
        evaluation.objective = std::numeric_limits<double>::quiet_NaN();
        evaluation.gradient  = Eigen::Vector2d::Zero();
      };
      const Minimum minimum = search_minimum(problem, Eigen::Vector2d(0., 0.), options_for(SearchMethod::ccsaq));
      EXPECT_EQ(minimum.status, MinimumStatus::failed);
      EXPECT_NE(minimum.message.find("not finite"), std::string::npos) << minimum.message;
    }

    TEST(GuardedSearch, ExceptionOfTheProblemComesBack)
    {
      MinimizationProblem problem = rosenbrock_problem();
      const auto          valley  = problem.evaluate;
      int                 n       = 0;
      problem.evaluate = [valley, &n](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
        if (++n == 3)
          throw InputError("a wrong value");
        valley(x, derivatives, evaluation);
      };
      EXPECT_THROW(search_minimum(problem, Eigen::Vector2d(-1.2, 1.), options_for(SearchMethod::mma)), InputError);
    }

    TEST(GuardedSearch, WrongInputIsRefused)
    {
      MinimizationProblem problem = rosenbrock_problem();
      EXPECT_THROW(search_minimum(problem, Eigen::VectorXd::Zero(3), {}), InputError);
      std::swap(problem.lower, problem.upper);
      EXPECT_THROW(search_minimum(problem, Eigen::Vector2d(0., 0.), {}), InputError);
      EXPECT_THROW(search_minimum(tutorial_problem(), tutorial_start, options_for(SearchMethod::lbfgs)), InputError);
      EXPECT_THROW(search_method("newton"), InputError);
    }
  } // namespace
} // namespace swimtwin
