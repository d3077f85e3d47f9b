#include <fom/algebra/linear_system.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    constexpr PetscInt n = 50;

    /// The tridiagonal matrix (-1, 2 + shift, -1), entry by entry, the diagonal in two contributions that add up.
    struct Chain
    {
      std::vector<PetscInt> rows, columns;
      std::vector<double>   values;

      explicit Chain(const double shift)
      {
        const auto add = [this](const PetscInt i, const PetscInt j, const double value) {
          rows.push_back(i);
          columns.push_back(j);
          values.push_back(value);
        };
        for (PetscInt i = 0; i < n; ++i)
        {
          add(i, i, 2.);
          add(i, i, shift);
          if (i > 0)
            add(i, i - 1, -1.);
          if (i + 1 < n)
            add(i, i + 1, -1.);
        }
      }
      std::vector<double> times(const std::vector<double> &x) const
      {
        std::vector<double> y(n, 0.);
        for (unsigned int k = 0; k < values.size(); ++k)
          y[rows[k]] += values[k] * x[columns[k]];
        return y;
      }
    };

    std::vector<double> wave()
    {
      std::vector<double> x(n);
      for (PetscInt i = 0; i < n; ++i)
        x[i] = std::sin(0.3 * i) + 0.1;
      return x;
    }

    bool solve_for_wave(LinearSystem &system, const Chain &chain, std::vector<double> &solution)
    {
      system.set_matrix(chain.values);
      system.set_right_hand_side(chain.times(wave()));
      return system.solve(solution);
    }

    /// The largest error; the condition number is about n^2 / 2.
    double error(const std::vector<double> &solution)
    {
      double largest = 0.;
      for (PetscInt i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(solution[i] - wave()[i]));
      return largest;
    }

    // The vectors of a chain, which is stiffer along one direction than across, and what becomes of it when they turn.
    Chain chain_of_vectors(const double angle)
    {
      const double c = std::cos(angle), s = std::sin(angle), along = 5., across = 1.;
      const double K[2][2] = {{along * c * c + across * s * s, (along - across) * c * s},
                              {(along - across) * c * s, along * s * s + across * c * c}};
      const Chain  chain(0.);
      Chain        vectors = chain;
      vectors.rows.clear();
      vectors.columns.clear();
      vectors.values.clear();
      for (std::size_t k = 0; k < chain.values.size(); ++k)
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            if (chain.rows[k] < n / 2 && chain.columns[k] < n / 2)
            {
              vectors.rows.push_back(2 * chain.rows[k] + i);
              vectors.columns.push_back(2 * chain.columns[k] + j);
              vectors.values.push_back(chain.values[k] * K[i][j]);
            }
      return vectors;
    }

    TEST(LinearSystem, FactorsOfABodySolveForTheTurnedBodyInTurnedAxes)
    {
      for (const bool knows_axes : {true, false})
      {
        const Chain         chain   = chain_of_vectors(0.);
        LinearSolverOptions options = {.tolerance = 1e-10};
        options.symmetric           = true;
        LinearSystem system(MPI_COMM_SELF, options);
        system.set_pattern(0, n, chain.rows, chain.columns);
        std::vector<TurnedAxes::Pair> pairs;
        for (PetscInt k = 0; k < n / 2; ++k)
          pairs.push_back({2 * k, 2 * k + 1});
        if (knows_axes)
          system.set_axes(pairs);
        std::vector<double> solution(n, 0.);
        ASSERT_TRUE(solve_for_wave(system, chain, solution));
        const int n_before = system.counts().n_iterations;
        if (knows_axes)
          system.turn_axes(std::vector<double>(n / 2, 0.4));
        std::fill(solution.begin(), solution.end(), 0.);
        ASSERT_TRUE(solve_for_wave(system, chain_of_vectors(0.4), solution));
        for (PetscInt i = 0; i < n; ++i)
          EXPECT_NEAR(solution[i], wave()[i], 1e-8);
        const int n_iterations = system.counts().n_iterations - n_before;
        EXPECT_EQ(n_iterations == 1 && system.counts().n_factorizations == 1, knows_axes) << n_iterations;
      }
    }
  } // namespace

  TEST(LinearSystem, SolvesToItsTolerance)
  {
    for (const bool positive_definite : {false, true})
    {
      LinearSolverOptions options;
      options.positive_definite = positive_definite;
      options.tolerance         = 1e-12;
      LinearSystem system(MPI_COMM_WORLD, options);
      const Chain  chain(0.);
      system.set_pattern(0, n, chain.rows, chain.columns);
      std::vector<double> solution(n, 0.);
      EXPECT_TRUE(solve_for_wave(system, chain, solution));
      EXPECT_LE(error(solution), 1e-12 * n * n);
      EXPECT_EQ(system.counts().n_solves, 1);
      EXPECT_EQ(system.counts().n_factorizations, 1);
    }
  }

  TEST(LinearSystem, StandardIterationsSolveToTheirTolerance)
  {
    for (const auto standard : {StandardPreconditioner::multigrid, StandardPreconditioner::subdomains})
      for (const bool reuse : {true, false})
      {
        LinearSolverOptions options;
        options.tolerance           = 1e-11;
        options.reuse_factorization = reuse;
        options.method              = LinearSolver::iterative;
        options.standard            = standard;
        LinearSystem system(MPI_COMM_WORLD, options);
        const Chain  chain(0.), nearby(1e-3);
        system.set_pattern(0, n, chain.rows, chain.columns);
        std::vector<double> solution(n, 0.);
        ASSERT_TRUE(solve_for_wave(system, chain, solution));
        EXPECT_LE(error(solution), 1e-11 * n * n);
        ASSERT_TRUE(solve_for_wave(system, nearby, solution));
        EXPECT_LE(error(solution), 1e-11 * n * n);
        EXPECT_EQ(system.counts().n_factorizations, reuse ? 1 : 2); // set up so many times
      }
  }

  TEST(LinearSystem, OldFactorsServeANearbyMatrixToTheSameTolerance)
  {
    LinearSolverOptions options;
    options.tolerance = 1e-12;
    LinearSystem system(MPI_COMM_WORLD, options);
    const Chain  chain(0.), nearby(1e-3);
    system.set_pattern(0, n, chain.rows, chain.columns);
    std::vector<double> solution(n, 0.);
    EXPECT_TRUE(solve_for_wave(system, chain, solution));
    solution.assign(n, 0.);
    EXPECT_TRUE(solve_for_wave(system, nearby, solution));
    EXPECT_EQ(system.counts().n_factorizations, 1);
    EXPECT_LE(error(solution), 1e-12 * n * n);
  }

  TEST(LinearSystem, FactorsThatNoLongerServeAreMadeAnew)
  {
    LinearSolverOptions options;
    options.tolerance            = 1e-12;
    options.max_stale_iterations = 3;
    LinearSystem system(MPI_COMM_WORLD, options);
    Chain        chain(0.), far(0.);
    for (unsigned int k = 0; k < far.values.size(); ++k)
      far.values[k] *= far.rows[k] == far.columns[k] ? 1. + far.rows[k] : 1.;
    system.set_pattern(0, n, chain.rows, chain.columns);
    std::vector<double> solution(n, 0.);
    EXPECT_TRUE(solve_for_wave(system, chain, solution));
    solution.assign(n, 0.);
    EXPECT_TRUE(solve_for_wave(system, far, solution));
    EXPECT_EQ(system.counts().n_factorizations, 2);
    EXPECT_LE(error(solution), 1e-12 * n * n);
  }

  TEST(LinearSystem, FactorsOfTheSameMatrixAreNeverMadeAgain)
  {
    LinearSolverOptions options;
    options.reuse_factorization = false;
    LinearSystem system(MPI_COMM_WORLD, options);
    const Chain  chain(0.);
    system.set_pattern(0, n, chain.rows, chain.columns);
    std::vector<double> solution(n, 0.);
    EXPECT_TRUE(solve_for_wave(system, chain, solution));
    const double response = system.response_to_load({{n / 2, 1.}});
    EXPECT_GT(response, 0.);
    EXPECT_EQ(system.counts().n_factorizations, 1);
    EXPECT_TRUE(solve_for_wave(system, chain, solution)); // the values were set again
    EXPECT_EQ(system.counts().n_factorizations, 2);
  }

  // A term that is not symmetric: small, corrections make up for it; large, LU takes over.
  TEST(LinearSystem, HalfOfTheMatrixServesUnlessItIsFarFromSymmetric)
  {
    for (const double skew : {0., 1e-6, 5.})
    {
      LinearSolverOptions options;
      options.tolerance = 1e-12;
      options.symmetric = true;
      LinearSystem system(MPI_COMM_WORLD, options);
      Chain        chain(0.);
      for (unsigned int k = 0; k < chain.values.size(); ++k)
        if (chain.rows[k] != chain.columns[k])
          chain.values[k] += chain.rows[k] > chain.columns[k] ? skew : -skew;
      system.set_pattern(0, n, chain.rows, chain.columns);
      for (int again = 1; again <= 2; ++again)
      {
        std::vector<double> solution(n, 0.);
        EXPECT_TRUE(solve_for_wave(system, chain, solution)) << skew;
        EXPECT_LE(error(solution), 1e-12 * n * n) << skew;
        EXPECT_EQ(system.counts().n_factorizations, skew > 1. ? 2 : 1) << skew;
      }
    }
  }

  TEST(LinearSystem, StiffMatrixIsSolvedAsFarAsDoublePrecisionAllows)
  {
    // Springs between neighbours are 3e8 times as stiff as what holds them in place, so that residuals of a motion of
    // all together are 1e-8 of the load by round-off alone: no solver reaches the tolerance, and this one does not
    // fail.
    Chain      stiff(0.);
    const auto spring = [](const PetscInt i) { return i == 0 || i == n ? 0. : 3e8 * (1.5 + std::sin(i)); };
    for (unsigned int k = 0; k < stiff.values.size(); ++k)
    {
      const PetscInt i = stiff.rows[k], j = stiff.columns[k];
      if (i != j)
        stiff.values[k] = -spring(std::max(i, j));
      else if (stiff.values[k] == 2.)
        stiff.values[k] = spring(i) + spring(i + 1);
      else
        stiff.values[k] = 1.3;
    }
    std::vector<double> load(n);
    for (PetscInt i = 0; i < n; ++i)
      load[i] = 1.3 + std::cos(7. * i);
    const double all_together = std::accumulate(load.begin(), load.end(), 0.) / (1.3 * n);
    for (const bool symmetric : {false, true})
    {
      LinearSystem system(PETSC_COMM_SELF, {.tolerance = 1e-12, .symmetric = symmetric});
      system.set_pattern(0, n, stiff.rows, stiff.columns);
      system.set_matrix(stiff.values);
      system.set_right_hand_side(load);
      std::vector<double> solution(n, 0.);
      EXPECT_TRUE(system.solve(solution)) << symmetric;
      for (const double value : solution)
        EXPECT_NEAR(value, all_together, 3e-6) << symmetric;
    }
  }

  TEST(LinearSystem, NaNIsReportedNotReturned)
  {
    LinearSystem system(MPI_COMM_WORLD, {});
    const Chain  chain(0.);
    system.set_pattern(0, n, chain.rows, chain.columns);
    system.set_matrix(chain.values);
    system.set_right_hand_side(std::vector<double>(n, std::numeric_limits<double>::quiet_NaN()));
    std::vector<double> solution(n, 0.);
    EXPECT_FALSE(system.solve(solution));
    solution.assign(n, 0.); // and it recovers
    EXPECT_TRUE(solve_for_wave(system, chain, solution));
    EXPECT_LE(error(solution), 1e-9 * n * n);
  }

  TEST(LinearSystem, SingularMatrixIsReportedAndForgotten)
  {
    LinearSystem system(MPI_COMM_WORLD, {});
    Chain        singular(0.);
    for (unsigned int k = 0; k < singular.values.size(); ++k)
      if (singular.rows[k] == 7 || singular.columns[k] == 7)
        singular.values[k] = 0.;
    system.set_pattern(0, n, singular.rows, singular.columns);
    std::vector<double> solution(n, 0.);
    system.set_matrix(singular.values);
    system.set_right_hand_side(std::vector<double>(n, 1.));
    EXPECT_FALSE(system.solve(solution));
    solution.assign(n, 0.);
    EXPECT_TRUE(solve_for_wave(system, Chain(0.), solution));
    EXPECT_LE(error(solution), 1e-9 * n * n);
  }

  // The inverse of the chain with shift 0 has entries (i + 1) (n - i) / (n + 1) on its diagonal; tolerance 1e-9.
  TEST(LinearSystem, RespondsToAUnitLoadByTheDiagonalOfTheInverse)
  {
    LinearSystem system(MPI_COMM_WORLD, {});
    const Chain  chain(0.);
    system.set_pattern(0, n, chain.rows, chain.columns);
    system.set_matrix(chain.values);
    for (const PetscInt i : {0, 7, 49})
      EXPECT_NEAR(system.response_to_load({{i, 1.}}), (i + 1.) * (n - i) / (n + 1.), 1e-8 * n);
  }
} // namespace swimtwin
