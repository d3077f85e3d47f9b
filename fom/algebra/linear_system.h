// A distributed sparse system that is assembled and solved many times with one pattern.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/algebra/block_preconditioner.h>
#include <fom/algebra/standard_iteration.h>
#include <fom/factors/kept_factors.h>
#include <fom/factors/mumps_factors.h>
#include <fom/factors/turned_axes.h>

#include <petscksp.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  /// Where factors take more memory than iterations by half, and as much time (docs/benchmarks.md).
  constexpr int  unknowns_for_iterations = 200'000;
  constexpr bool iterates(const LinearSolver method, const int dimension, const PetscInt n_unknowns)
  {
    return method == LinearSolver::iterative ||
           (method == LinearSolver::automatic && dimension == 3 && n_unknowns > unknowns_for_iterations);
  }

  /// How hard the solver worked, over all solves.
  struct LinearSolverCounts
  {
    int    n_solves = 0, n_factorizations = 0, n_iterations = 0;
    double assembly_cpu_s = 0., factorization_cpu_s = 0., solve_cpu_s = 0.;
  };

  struct LinearSolverOptions
  {
    double tolerance = 1e-9; ///< on the preconditioned residual, relative to the guess or, without one, to the solution
    bool   reuse_factorization  = true; ///< keep the last factors as preconditioner while they serve
    int    max_stale_iterations = 12;   ///< give up on old factors after so many GMRES iterations and factorise anew
    int  factorization_effort = 8; ///< of a factorisation in GMRES iterations: 7 to 8 measured in 2D at 17,000 unknowns
    bool positive_definite    = false; ///< Cholesky instead of LU
    bool symmetric            = false; ///< factorise the upper triangle of symmetric matrices alone, LDL^T
    /// Iterative: with a standard preconditioner, or one of blocks once they are known; the tolerance is on the
    /// residual, relative to the right-hand side. Automatic: from `unknowns_for_iterations` on in space.
    LinearSolver           method   = LinearSolver::direct;
    StandardPreconditioner standard = StandardPreconditioner::none;
  };

  /// Matrix entries are given by rows and columns once (MatSetPreallocationCOO), then only their values change; entries
  /// given several times add up, those with a negative index are dropped. MUMPS keeps its analysis with the pattern.
  class LinearSystem
  {
  public:
    LinearSystem(MPI_Comm communicator, const LinearSolverOptions &options);
    ~LinearSystem();
    LinearSystem(const LinearSystem &)            = delete;
    LinearSystem &operator=(const LinearSystem &) = delete;

    /// Rows [first, last) live on this rank; `rows` and `columns` are this rank's contributions. `dimension`: of the
    /// mesh behind them, which says how far factors fill in. Collective; throws ComputationError for want of memory.
    void set_pattern(PetscInt first_row, PetscInt last_row, std::vector<PetscInt> rows, std::vector<PetscInt> columns,
                     int dimension = 2);
    /// For a solver with factors: which of this rank's unknowns turn with a body, so that old factors are used in axes
    /// that have turned too. After the pattern; collective.
    void set_axes(std::vector<TurnedAxes::Pair> pairs);
    bool has_axes() const { return turned_ksp_ != nullptr; }
    /// How they are turned, as TurnedAxes::set_angles; with the matrix.
    void turn_axes(std::vector<double> angles) { axes_.set_angles(std::move(angles)); }
    /// For an iterative solver: what this rank's unknowns are. Collective.
    void set_kinds(const std::vector<UnknownKind> &kinds);
    /// The same: this rank's contributions to the diagonal of the pressures' mass matrix over the viscosity, of full
    /// length. Collective.
    void set_masses(const std::vector<double> &contributions);
    /// Values in the order of the pattern. `is_symmetric`: not always so under the option `symmetric`. Collective.
    void set_matrix(const std::vector<double> &values, bool is_symmetric = true);
    /// This rank's contributions to the right-hand side, of full length; summed over ranks. Collective.
    void set_right_hand_side(const std::vector<double> &contributions);

    /// For the solves to come: a tolerance below that of the options. A solve that, with fresh factors, reaches only
    /// that of the options, or what double precision allows, has not failed.
    void aim_at(const double tolerance) { tolerance_ = tolerance; }

    /// Factorise anew at the next solve, so that what follows does not depend on what was before.
    void forget_factors() { has_factors_ = false; }

    /// Solve and replace `solution` (full length on every rank), from which old factors start; new ones need no guess.
    /// False if neither gave the tolerance, or the result is not finite. Collective.
    bool solve(std::vector<double> &solution);
    /// Solve for several right-hand sides (full length, the same on every rank) by one factorisation of the matrix as
    /// it is, without iterations, and replace them by their solutions. Collective.
    bool solve_together(std::vector<std::vector<double>> &columns);

    /// Response of unknowns to a load on them alone, each times its load: f^T A^-1 f; not a number if it could not be
    /// solved for. Replaces the right-hand side. Collective.
    double response_to_load(const std::vector<std::pair<PetscInt, double>> &load);

    bool                      is_iterative() const { return is_iterative_; } ///< once the pattern is set
    const LinearSolverCounts &counts() const { return counts_; }
    void                      set_counts(const LinearSolverCounts &counts) { counts_ = counts; }
    PetscInt                  size() const { return size_; }
    Mat                       matrix() const { return matrix_; }

  private:
    void clear();
    void note_effort(int iterations);
    bool factorize();
    void apply_turned_factors(Vec x, Vec y);
    /// From the solution as it is, to the tolerances of this solver.
    bool iterate(KSP ksp);
    bool iterate_with_old_factors(const std::vector<double> &guess);
    /// With factors of the matrix as it is, from nothing.
    bool refine();
    bool solve_by_iterations(const std::vector<double> &guess);
    bool set_up_preconditioner();
    bool iterate_from(const std::vector<double> &guess);
    void gather_solution(); ///< into `gathered_`, on every rank
    void gather_solution(std::vector<double> &solution);
    void fill(Vec vector, const std::vector<double> &contributions) const;
    void set_guess(const std::vector<double> &guess);
    /// Of the solution as it is; leaves the residual behind.
    double residual_norm();
    /// Of the solution with that residual: the largest share of a row's residual in the sizes of its terms (Oettli and
    /// Prager 1964). With the matrix changed by that share, entry by entry, the solution is exact. Collective.
    double backward_error();

    MPI_Comm                             communicator_;
    LinearSolverOptions                  options_;
    LinearSolverCounts                   counts_;
    double                               tolerance_  = options_.tolerance;
    Mat                                  matrix_     = nullptr;
    Vec                                  rhs_        = nullptr;
    Vec                                  solution_   = nullptr;
    Vec                                  residual_   = nullptr;
    Vec                                  correction_ = nullptr;
    Vec                                  gathered_   = nullptr;
    VecScatter                           gather_     = nullptr;
    MumpsFactors                         factors_;
    KSP                                  turned_ksp_ = nullptr; ///< with the same factors, in turned axes
    Vec                                  turned_     = nullptr;
    TurnedAxes                           axes_;
    Vec                                  masses_    = nullptr; ///< of pressures
    KSP                                  block_ksp_ = nullptr;
    PetscInt                             size_ = 0, first_row_ = 0, last_row_ = 0;
    std::unique_ptr<BlockPreconditioner> blocks_;
    std::unique_ptr<StandardIteration>   standard_;
    bool                                 has_factors_ = false, factors_are_old_ = true;
    bool                                 matrix_is_symmetric_ = true, is_iterative_ = false;
    KeptFactors                          kept_; ///< or another preconditioner
  };
} // namespace swimtwin
