#include <fom/algebra/solver_memory.h>

#include <datasets/system/error.h>
#include <datasets/system/memory_limits.h>

#include <fmt/format.h>

#include <string>

namespace swimtwin
{
  namespace
  {
    constexpr const char *remedy = "choose a coarser mesh ([numerics] mesh_growth and mesh sizes)";

    /// For so many unknowns there was memory: a new mesh of the same size takes the place of the old one.
    PetscInt largest_so_far = 0;

    /// What this rank lacks, or nothing.
    std::string shortage(const PetscInt n_unknowns, const int n_ranks)
    {
      const double total_MB = memory_per_unknown_MB * (n_unknowns - largest_so_far), own_MB = total_MB / n_ranks;
      try
      {
        require_memory(fmt::format("a system of {} unknowns", n_unknowns), {own_MB, own_MB, total_MB}, remedy);
        return {};
      }
      catch (const ComputationError &error)
      {
        return error.what();
      }
    }
  } // namespace

  void require_memory_for_unknowns(const PetscInt n_unknowns, const MPI_Comm communicator)
  {
    if (n_unknowns <= largest_so_far)
      return;
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    const std::string own          = shortage(n_unknowns, n_ranks);
    int               someone_else = own.empty() ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &someone_else, 1, MPI_INT, MPI_MAX, communicator);
    if (someone_else != 0)
      throw ComputationError(
          own.empty()
              ? fmt::format("another rank has too little memory for its part of {} unknowns; {}", n_unknowns, remedy)
              : own);
    largest_so_far = n_unknowns;
  }
} // namespace swimtwin
