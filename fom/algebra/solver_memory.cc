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

    /// So much memory there was: a new mesh of the same size takes the place of the old one.
    double largest_so_far_MB = 0.;

    /// What this rank lacks, or nothing.
    std::string shortage(const PetscInt n_unknowns, const double needed_MB, const int n_ranks)
    {
      const double total_MB = needed_MB - largest_so_far_MB, own_MB = total_MB / n_ranks;
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

  void require_memory_for_unknowns(const PetscInt n_unknowns, const int dimension, const bool iterative,
                                   const MPI_Comm communicator)
  {
    const double needed_MB = system_memory_MB(n_unknowns, dimension, iterative);
    if (needed_MB <= largest_so_far_MB)
      return;
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    const std::string own          = shortage(n_unknowns, needed_MB, n_ranks);
    int               someone_else = own.empty() ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &someone_else, 1, MPI_INT, MPI_MAX, communicator);
    if (someone_else != 0)
      throw ComputationError(
          own.empty()
              ? fmt::format("another rank has too little memory for its part of {} unknowns; {}", n_unknowns, remedy)
              : own);
    largest_so_far_MB = needed_MB;
  }
} // namespace swimtwin
