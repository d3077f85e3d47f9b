#include <fom/algebra/linear_system.h>

#include <fom/algebra/cpu_time.h>
#include <fom/algebra/solver_memory.h>
#include <fom/factors/petsc_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr int most_block_iterations = 150, most_standard_iterations = 1000, gmres_restart = 60;

    bool is_finite(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(), [](const double value) { return std::isfinite(value); });
    }

    void set_up_iteration(const KSP ksp, const KSPType type, const PetscInt restart)
    {
      check_petsc(KSPSetType(ksp, type), "made a solver");
      check_petsc(KSPGMRESSetRestart(ksp, restart), "made a solver");
      check_petsc(KSPSetInitialGuessNonzero(ksp, PETSC_TRUE), "made a solver");
    }

    /// A preconditioner of our own.
    void use_shell(const KSP ksp, void *context, PetscErrorCode (*apply)(PC, Vec, Vec))
    {
      PC pc;
      check_petsc(KSPGetPC(ksp, &pc), "made a solver");
      check_petsc(PCSetType(pc, PCSHELL), "made a solver");
      check_petsc(PCShellSetContext(pc, context), "made a solver");
      check_petsc(PCShellSetApply(pc, apply), "made a solver");
    }

    PetscInt sum_over_ranks(PetscInt value, const MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPIU_INT, MPI_SUM, communicator);
      return value;
    }

  } // namespace

  LinearSystem::LinearSystem(const MPI_Comm communicator, const LinearSolverOptions &options)
      : communicator_(communicator), options_(options)
  {
  }

  LinearSystem::~LinearSystem()
  {
    clear();
  }

  void LinearSystem::clear()
  {
    KSPDestroy(&block_ksp_);
    standard_.reset();
    KSPDestroy(&turned_ksp_);
    VecDestroy(&turned_);
    axes_ = {};
    blocks_.reset();
    VecDestroy(&masses_);
    VecScatterDestroy(&gather_);
    VecDestroy(&gathered_);
    VecDestroy(&correction_);
    VecDestroy(&residual_);
    VecDestroy(&solution_);
    VecDestroy(&rhs_);
    factors_.clear();
    MatDestroy(&matrix_);
    has_factors_ = false;
  }

  void LinearSystem::set_pattern(const PetscInt first_row, const PetscInt last_row, std::vector<PetscInt> rows,
                                 std::vector<PetscInt> columns, const int dimension)
  {
    const ScopedCpuTime time(counts_.assembly_cpu_s);
    clear();
    const PetscInt n_unknowns = sum_over_ranks(last_row - first_row, communicator_);
    is_iterative_             = iterates(options_.method, dimension, n_unknowns);
    require_memory_for_unknowns(n_unknowns, dimension, is_iterative_, communicator_);
    first_row_ = first_row;
    last_row_  = last_row;
    check_petsc(MatCreate(communicator_, &matrix_), "made a matrix");
    check_petsc(MatSetSizes(matrix_, last_row - first_row, last_row - first_row, PETSC_DETERMINE, PETSC_DETERMINE),
                "sized a matrix");
    check_petsc(MatSetType(matrix_, MATAIJ), "made a matrix");
    check_petsc(MatSetPreallocationCOO(matrix_, rows.size(), rows.data(), columns.data()), "laid out a matrix");
    if (options_.positive_definite)
      check_petsc(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE), "marked a matrix");
    check_petsc(MatCreateVecs(matrix_, &solution_, &rhs_), "made vectors");
    check_petsc(VecDuplicate(solution_, &residual_), "made vectors");
    check_petsc(VecDuplicate(solution_, &correction_), "made vectors");
    check_petsc(VecGetSize(rhs_, &size_), "sized vectors");
    check_petsc(VecScatterCreateToAll(solution_, &gather_, &gathered_), "made vectors");

    factors_.set_matrix(communicator_, matrix_, options_.positive_definite);
    set_up_iteration(factors_.solver(), KSPGMRES, gmres_restart);
    check_petsc(KSPConvergedDefaultSetUIRNorm(factors_.solver()), "made a solver");
    if (is_iterative_ && options_.standard != StandardPreconditioner::none)
      standard_ = std::make_unique<StandardIteration>(communicator_, matrix_, options_.standard);
  }

  void LinearSystem::set_matrix(const std::vector<double> &values, const bool is_symmetric)
  {
    const ScopedCpuTime time(counts_.assembly_cpu_s);
    check_petsc(MatSetValuesCOO(matrix_, values.data(), INSERT_VALUES), "filled a matrix");
    factors_are_old_     = true;
    matrix_is_symmetric_ = is_symmetric;
  }

  void LinearSystem::set_right_hand_side(const std::vector<double> &contributions)
  {
    const ScopedCpuTime time(counts_.assembly_cpu_s);
    fill(rhs_, contributions);
  }

  void LinearSystem::fill(const Vec vector, const std::vector<double> &contributions) const
  {
    std::vector<PetscInt> indices;
    std::vector<double>   values;
    for (PetscInt i = 0; i < size_; ++i)
      if (contributions[i] != 0.)
      {
        indices.push_back(i);
        values.push_back(contributions[i]);
      }
    VecZeroEntries(vector);
    check_petsc(VecSetValues(vector, indices.size(), indices.data(), values.data(), ADD_VALUES), "filled a vector");
    check_petsc(VecAssemblyBegin(vector), "filled a vector");
    check_petsc(VecAssemblyEnd(vector), "filled a vector");
  }

  void LinearSystem::set_kinds(const std::vector<UnknownKind> &kinds)
  {
    blocks_ = std::make_unique<BlockPreconditioner>(communicator_, first_row_, kinds);
    check_petsc(VecDuplicate(rhs_, &masses_), "made vectors");
    check_petsc(KSPCreate(communicator_, &block_ksp_), "made a solver");
    check_petsc(KSPSetOperators(block_ksp_, matrix_, matrix_), "made a solver");
    set_up_iteration(block_ksp_, KSPFGMRES, most_block_iterations);
    use_shell(block_ksp_, blocks_.get(), [](PC shell, Vec x, Vec y) -> PetscErrorCode {
      void *blocks;
      PCShellGetContext(shell, &blocks);
      static_cast<BlockPreconditioner *>(blocks)->apply(x, y);
      return 0;
    });
  }

  void LinearSystem::set_axes(std::vector<TurnedAxes::Pair> pairs)
  {
    axes_.set_pairs(std::move(pairs), first_row_);
    check_petsc(VecDuplicate(solution_, &turned_), "made vectors");
    check_petsc(KSPCreate(communicator_, &turned_ksp_), "made a solver");
    check_petsc(KSPSetOperators(turned_ksp_, matrix_, matrix_), "made a solver");
    set_up_iteration(turned_ksp_, KSPGMRES, gmres_restart);
    check_petsc(KSPConvergedDefaultSetUIRNorm(turned_ksp_), "made a solver");
    use_shell(turned_ksp_, this, [](PC shell, Vec x, Vec y) -> PetscErrorCode {
      void *system;
      PCShellGetContext(shell, &system);
      static_cast<LinearSystem *>(system)->apply_turned_factors(x, y);
      return 0;
    });
  }

  void LinearSystem::apply_turned_factors(const Vec x, const Vec y)
  {
    VecCopy(x, turned_);
    axes_.to_factors(turned_);
    factors_.apply(turned_, y);
    axes_.from_factors(y);
  }

  void LinearSystem::set_masses(const std::vector<double> &contributions)
  {
    const ScopedCpuTime time(counts_.assembly_cpu_s);
    fill(masses_, contributions);
  }

  bool LinearSystem::set_up_preconditioner()
  {
    const ScopedCpuTime time(counts_.factorization_cpu_s);
    ++counts_.n_factorizations;
    has_factors_     = standard_ ? standard_->set_up() : blocks_->set_up(matrix_, masses_, matrix_is_symmetric_);
    factors_are_old_ = !has_factors_;
    kept_.make(options_.factorization_effort);
    return has_factors_;
  }

  bool LinearSystem::iterate(const KSP ksp)
  {
    check_petsc(KSPSolve(ksp, rhs_, solution_), "solved");
    PetscInt           iterations;
    KSPConvergedReason reason;
    check_petsc(KSPGetIterationNumber(ksp, &iterations), "solved");
    check_petsc(KSPGetConvergedReason(ksp, &reason), "solved");
    note_effort(iterations);
    return reason > 0;
  }

  bool LinearSystem::iterate_from(const std::vector<double> &guess)
  {
    const ScopedCpuTime time(counts_.solve_cpu_s);
    const KSP           ksp = standard_ ? standard_->solver() : block_ksp_;
    set_guess(guess);
    check_petsc(
        KSPSetTolerances(ksp, tolerance_, 1e-300, 1e10, standard_ ? most_standard_iterations : most_block_iterations),
        "set up a solver");
    return iterate(ksp);
  }

  bool LinearSystem::solve_by_iterations(const std::vector<double> &guess)
  {
    const bool may_be_old = blocks_ || options_.reuse_factorization;
    const bool serves     = has_factors_ && (!factors_are_old_ || (may_be_old && !kept_.are_worn()));
    return (serves && iterate_from(guess)) || (set_up_preconditioner() && iterate_from(guess));
  }

  bool LinearSystem::factorize()
  {
    const ScopedCpuTime time(counts_.factorization_cpu_s);
    ++counts_.n_factorizations;
    has_factors_     = factors_.compute();
    factors_are_old_ = !has_factors_;
    axes_.note_factors();
    kept_.make(options_.factorization_effort);
    return has_factors_;
  }

  void LinearSystem::set_guess(const std::vector<double> &guess)
  {
    double *local;
    VecGetArray(solution_, &local);
    std::copy(guess.begin() + first_row_, guess.begin() + last_row_, local);
    VecRestoreArray(solution_, &local);
  }

  bool LinearSystem::iterate_with_old_factors(const std::vector<double> &guess)
  {
    const ScopedCpuTime time(counts_.solve_cpu_s);
    set_guess(guess);
    check_petsc(KSPSetReusePreconditioner(factors_.solver(), PETSC_TRUE), "set up a solver");
    // Relative to the solution: its guess has that size. Without one the first residual has it; it also bounds from
    // below what a guess that is far too small would ask for.
    double guess_norm;
    VecNorm(solution_, NORM_2, &guess_norm);
    const bool has_guess = guess_norm > 0.;
    const KSP  ksp       = has_axes() ? turned_ksp_ : factors_.solver();
    check_petsc(KSPSetTolerances(ksp, (has_guess ? 1e-3 : 1.) * tolerance_,
                                 has_guess ? tolerance_ * guess_norm : 1e-300, 1e10, options_.max_stale_iterations),
                "set up a solver");
    return iterate(ksp);
  }

  double LinearSystem::residual_norm()
  {
    double norm;
    check_petsc(MatResidual(matrix_, rhs_, solution_, residual_), "solved");
    VecNorm(residual_, NORM_2, &norm);
    return norm;
  }

  double LinearSystem::backward_error()
  {
    gather_solution();
    const double *solution, *rhs, *residual;
    VecGetArrayRead(gathered_, &solution);
    VecGetArrayRead(rhs_, &rhs);
    VecGetArrayRead(residual_, &residual);
    double largest = 0.;
    for (PetscInt row = first_row_; row < last_row_; ++row)
    {
      PetscInt           n_entries;
      const PetscInt    *columns;
      const PetscScalar *values;
      check_petsc(MatGetRow(matrix_, row, &n_entries, &columns, &values), "read a matrix");
      double terms = std::abs(rhs[row - first_row_]);
      for (PetscInt k = 0; k < n_entries; ++k)
        terms += std::abs(values[k] * solution[columns[k]]);
      check_petsc(MatRestoreRow(matrix_, row, &n_entries, &columns, &values), "read a matrix");
      if (residual[row - first_row_] != 0.)
        largest = std::max(largest, std::abs(residual[row - first_row_]) / terms);
    }
    VecRestoreArrayRead(residual_, &residual);
    VecRestoreArrayRead(rhs_, &rhs);
    VecRestoreArrayRead(gathered_, &solution);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator_);
    return largest;
  }

  bool LinearSystem::refine()
  {
    // One solve with the factors is enough, and the residuals, whose rows are scaled in another way, show it. Where
    // they do not, a correction that is itself below the tolerance is the last one. One that shrinks no more is
    // round-off where it is small, or where the residual is that of a matrix rounded to double precision (a stiff tail
    // in a thin fluid): no solver has a better solution.
    constexpr int       most_corrections = 6;
    constexpr double    scaling          = 1e3; // between shares of residuals and of errors; 300 seen
    const double        round_off        = std::max(options_.tolerance, 1e-9); // at most, without that proof
    constexpr double    most_round_off = 1e-6, rounded_matrix = 1e-14;
    const ScopedCpuTime time(counts_.solve_cpu_s);
    // No guess: a residual costs more than what it would save.
    VecZeroEntries(solution_);
    VecCopy(rhs_, residual_);
    double before, change_before = std::numeric_limits<double>::infinity();
    VecNorm(residual_, NORM_2, &before);
    for (int n = 1; n <= most_corrections; ++n)
    {
      double change, size;
      factors_.apply(residual_, correction_);
      VecAXPY(solution_, 1., correction_);
      VecNorm(correction_, NORM_2, &change);
      VecNorm(solution_, NORM_2, &size);
      note_effort(1);
      const double after = residual_norm();
      if (change <= tolerance_ * size || scaling * (after / before) * change <= tolerance_ * size)
        return true;
      if (!(change < .5 * change_before))
        return change <= round_off * size || (change <= most_round_off * size && backward_error() <= rounded_matrix);
      before        = after;
      change_before = change;
    }
    return false;
  }

  void LinearSystem::note_effort(const int iterations)
  {
    counts_.n_iterations += iterations;
    kept_.note_solve(iterations);
  }

  bool LinearSystem::solve(std::vector<double> &solution)
  {
    ++counts_.n_solves;
    bool converged = false;
    if (blocks_ || standard_)
    {
      converged = solve_by_iterations(solution);
      gather_solution(solution);
      return converged && is_finite(solution);
    }
    if (has_factors_ && !factors_are_old_)
      converged = refine();
    else if (has_factors_ && options_.reuse_factorization && !kept_.are_worn())
      converged = iterate_with_old_factors(solution);
    if (!converged && options_.symmetric && !matrix_is_symmetric_)
      factors_.use_whole();
    else if (!converged && options_.symmetric)
    {
      // Half the work; where pivots fail it, what follows takes the whole matrix.
      factors_.use_upper_triangle();
      converged = factorize() && refine();
      if (!converged)
        factors_.use_whole();
    }
    if (!converged)
      converged = factorize() && refine();
    gather_solution(solution);
    return converged && is_finite(solution);
  }

  void LinearSystem::gather_solution()
  {
    VecScatterBegin(gather_, solution_, gathered_, INSERT_VALUES, SCATTER_FORWARD);
    VecScatterEnd(gather_, solution_, gathered_, INSERT_VALUES, SCATTER_FORWARD);
  }

  void LinearSystem::gather_solution(std::vector<double> &solution)
  {
    gather_solution();
    const double *all;
    VecGetArrayRead(gathered_, &all);
    solution.assign(all, all + size_);
    VecRestoreArrayRead(gathered_, &all);
  }

  bool LinearSystem::solve_together(std::vector<std::vector<double>> &columns)
  {
    if (options_.symmetric)
      factors_.use_upper_triangle();
    if (!factorize())
      return false;
    const ScopedCpuTime time(counts_.solve_cpu_s);
    counts_.n_solves += columns.size();
    const PetscInt n = columns.size(), n_local = last_row_ - first_row_;
    Mat            B, X;
    for (Mat *M : {&B, &X})
      check_petsc(MatCreateDense(communicator_, n_local, PETSC_DECIDE, size_, n, nullptr, M),
                  "made a block of vectors");
    double *local;
    check_petsc(MatDenseGetArrayWrite(B, &local), "filled a block of vectors");
    for (PetscInt j = 0; j < n; ++j)
      std::copy_n(columns[j].begin() + first_row_, n_local, local + j * n_local);
    check_petsc(MatDenseRestoreArrayWrite(B, &local), "filled a block of vectors");
    factors_.apply(B, X);

    const double *solved;
    check_petsc(MatDenseGetArrayRead(X, &solved), "solved");
    bool finite = true;
    for (PetscInt j = 0; j < n; ++j)
    {
      std::fill(columns[j].begin(), columns[j].end(), 0.);
      std::copy_n(solved + j * n_local, n_local, columns[j].begin() + first_row_);
      MPI_Allreduce(MPI_IN_PLACE, columns[j].data(), size_, MPI_DOUBLE, MPI_SUM, communicator_);
      for (const double value : columns[j])
        finite = finite && std::isfinite(value);
    }
    check_petsc(MatDenseRestoreArrayRead(X, &solved), "solved");
    MatDestroy(&X);
    MatDestroy(&B);
    return finite;
  }

  double LinearSystem::response_to_load(const std::vector<std::pair<PetscInt, double>> &entries)
  {
    std::vector<double> load(size_, 0.), response(size_, 0.);
    for (const auto &[unknown, value] : entries)
      if (first_row_ <= unknown && unknown < last_row_)
        load[unknown] = value;
    set_right_hand_side(load);
    if (!solve(response))
      return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.;
    for (const auto &[unknown, value] : entries)
      sum += value * response[unknown];
    return sum;
  }
} // namespace swimtwin
