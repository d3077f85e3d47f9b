#include <fom/factors/mumps_factors.h>

#include <fom/factors/petsc_error.h>

namespace swimtwin
{
  namespace
  {
    PC preconditioner_of(const KSP ksp)
    {
      PC pc;
      check_petsc(KSPGetPC(ksp, &pc), "set up a solver");
      return pc;
    }

    void use_factors(const KSP ksp, const PCType type)
    {
      const PC pc = preconditioner_of(ksp);
      check_petsc(PCSetType(pc, type), "made a solver");
      check_petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "chose MUMPS");
    }

    /// Before factors are made: MUMPS's own matrix, for settings.
    Mat factors_to_be(const KSP ksp)
    {
      const PC pc = preconditioner_of(ksp);
      Mat      factors;
      check_petsc(PCFactorSetUpMatSolverType(pc), "made a solver");
      check_petsc(PCFactorGetMatrix(pc, &factors), "made a solver");
      return factors;
    }

    /// Why MUMPS failed: its INFOG(1).
    PetscInt failure_of_mumps(const KSP ksp)
    {
      PetscInt code;
      check_petsc(MatMumpsGetInfog(factors_to_be(ksp), 1, &code), "factorised");
      return code;
    }

    /// PETSc does not call MUMPS again after a failure: with new factors, of the same kind, that may take more
    /// workspace.
    void start_factors_anew(const KSP ksp, const Mat matrix, const PetscInt extra_percent)
    {
      PetscInt ordering; // chosen by hand for symmetric factors
      check_petsc(MatMumpsGetIcntl(factors_to_be(ksp), 12, &ordering), "set up MUMPS");
      check_petsc(KSPReset(ksp), "dropped failed factors");
      check_petsc(KSPSetOperators(ksp, matrix, matrix), "set up a solver");
      check_petsc(MatMumpsSetIcntl(factors_to_be(ksp), 12, ordering), "set up MUMPS");
      check_petsc(MatMumpsSetIcntl(factors_to_be(ksp), 14, extra_percent), "set up MUMPS");
    }
  } // namespace

  void MumpsFactors::clear()
  {
    KSPDestroy(&ksp_);
  }

  void MumpsFactors::set_matrix(const MPI_Comm communicator, const Mat matrix, const bool is_positive_definite)
  {
    clear();
    matrix_ = matrix;
    check_petsc(KSPCreate(communicator, &ksp_), "made a solver");
    check_petsc(KSPSetOperators(ksp_, matrix_, matrix_), "made a solver");
    use_factors(ksp_, is_positive_definite ? PCCHOLESKY : PCLU);
  }

  void MumpsFactors::use_whole()
  {
    use_factors(ksp_, PCLU);
  }

  /// MUMPS orders by the pattern (ICNTL(12) = 1), not by the first values it sees: a resumed run sees others, and
  /// repeats the arithmetic all the same.
  void MumpsFactors::use_upper_triangle()
  {
    use_factors(ksp_, PCCHOLESKY);
    check_petsc(MatMumpsSetIcntl(factors_to_be(ksp_), 12, 1), "set up MUMPS");
  }

  bool MumpsFactors::compute()
  {
    check_petsc(KSPSetReusePreconditioner(ksp_, PETSC_FALSE), "set up a solver");
    // Tell the preconditioner that the values changed, then factorise here so that its time is counted here.
    check_petsc(KSPSetOperators(ksp_, matrix_, matrix_), "set up a solver");
    if (set_up() || set_up_in_larger_workspace())
      return true;
    check_petsc(KSPReset(ksp_), "dropped failed factors");
    return false;
  }

  bool MumpsFactors::set_up()
  {
    check_petsc(KSPSetUp(ksp_), "factorised");
    PCFailedReason failure;
    check_petsc(PCGetFailedReason(preconditioner_of(ksp_), &failure), "factorised");
    return failure == PC_NOERROR;
  }

  /// MUMPS sizes its workspace before it sees which pivots it must put off: -8 and -9 say that it was too small. Its
  /// analysis (-5, -7) and its factors (-13) may find no memory at all.
  bool MumpsFactors::set_up_in_larger_workspace()
  {
    for (const PetscInt extra_percent : {100, 400})
    {
      const PetscInt code = failure_of_mumps(ksp_);
      if (code == -5 || code == -7 || code == -13)
        throw out_of_memory("factorised");
      if (code != -8 && code != -9)
        return false;
      start_factors_anew(ksp_, matrix_, extra_percent);
      if (set_up())
        return true;
    }
    return false;
  }

  void MumpsFactors::apply(const Vec x, const Vec y) const
  {
    check_petsc(PCApply(preconditioner_of(ksp_), x, y), "solved");
  }

  void MumpsFactors::apply(const Mat B, const Mat X) const
  {
    Mat factors;
    check_petsc(PCFactorGetMatrix(preconditioner_of(ksp_), &factors), "solved");
    check_petsc(MatMatSolve(factors, B, X), "solved");
  }
} // namespace swimtwin
