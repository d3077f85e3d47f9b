#include <fom/algebra/standard_iteration.h>

#include <fom/factors/petsc_error.h>

#include <string>

namespace swimtwin
{
  namespace
  {
    constexpr const char *prefix_of_subdomains = "swimtwin_subdomain_";

    void choose_factors_of_subdomains(const KSP ksp)
    {
      for (const auto &[name, value] :
           {std::pair{"sub_pc_type", "lu"}, std::pair{"sub_pc_factor_mat_solver_type", "mumps"}})
        check_petsc(PetscOptionsSetValue(nullptr, (std::string("-") + prefix_of_subdomains + name).c_str(), value),
                    "made a solver");
      check_petsc(KSPSetOptionsPrefix(ksp, prefix_of_subdomains), "made a solver");
    }
  } // namespace

  StandardIteration::StandardIteration(const MPI_Comm communicator, const Mat matrix,
                                       const StandardPreconditioner preconditioner)
      : matrix_(matrix)
  {
    const bool is_multigrid = preconditioner == StandardPreconditioner::multigrid;
    PC         pc;
    check_petsc(KSPCreate(communicator, &ksp_), "made a solver");
    check_petsc(KSPSetOperators(ksp_, matrix_, matrix_), "made a solver");
    check_petsc(KSPSetType(ksp_, is_multigrid ? KSPCG : KSPGMRES), "made a solver");
    check_petsc(KSPSetInitialGuessNonzero(ksp_, PETSC_TRUE), "made a solver");
    check_petsc(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED), "made a solver");
    check_petsc(KSPGetPC(ksp_, &pc), "made a solver");
    check_petsc(PCSetType(pc, is_multigrid ? PCGAMG : PCGASM), "made a solver");
    if (!is_multigrid)
    {
      check_petsc(KSPSetPCSide(ksp_, PC_RIGHT), "made a solver");
      check_petsc(KSPGMRESSetRestart(ksp_, 300), "made a solver"); // few subdomains, but a slender body
      check_petsc(PCGASMSetOverlap(pc, 1), "made a solver");
      choose_factors_of_subdomains(ksp_);
      check_petsc(PCSetFromOptions(pc), "made a solver");
    }
  }

  StandardIteration::~StandardIteration()
  {
    KSPDestroy(&ksp_);
  }

  bool StandardIteration::set_up()
  {
    PC             pc;
    PCFailedReason failure;
    check_petsc(KSPSetReusePreconditioner(ksp_, PETSC_FALSE), "set up a solver");
    check_petsc(KSPSetOperators(ksp_, matrix_, matrix_), "set up a solver"); // tells that the values changed
    check_petsc(KSPSetUp(ksp_), "set up a solver");
    check_petsc(KSPSetUpOnBlocks(ksp_), "set up a solver");
    check_petsc(KSPSetReusePreconditioner(ksp_, PETSC_TRUE), "set up a solver"); // until it is set up again
    check_petsc(KSPGetPC(ksp_, &pc), "set up a solver");
    check_petsc(PCGetFailedReason(pc, &failure), "set up a solver");
    int someone_failed = failure != PC_NOERROR; // each rank knows of its own subdomain
    MPI_Allreduce(MPI_IN_PLACE, &someone_failed, 1, MPI_INT, MPI_MAX,
                  PetscObjectComm(reinterpret_cast<PetscObject>(ksp_)));
    return someone_failed == 0;
  }
} // namespace swimtwin
