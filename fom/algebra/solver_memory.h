// Memory of the full-order model, as its factorisations need it.
#pragma once

#include <petscsys.h>

#include <mpi.h>

namespace swimtwin
{
  /// One process, 2D, MUMPS: resident memory against unknowns of the coupled system, measured from 5,000 to 60,000.
  constexpr double process_memory_MB = 195., memory_per_unknown_MB = 0.004;
  /// In 3D, measured at 29,000 and 57,000.
  constexpr double memory_per_unknown_in_space_MB = 0.0155;
  /// The same with iterations instead of factors, measured at 72,000 and 163,000.
  constexpr double memory_per_iterated_unknown_MB = 0.012;

  /// Memory (MB) of a coupled system and its factors, on meshes of a dimension.
  constexpr double system_memory_MB(const double n_unknowns, const int dimension, const bool iterative = false)
  {
    if (iterative)
      return memory_per_iterated_unknown_MB * n_unknowns;
    return (dimension == 3 ? memory_per_unknown_in_space_MB : memory_per_unknown_MB) * n_unknowns;
  }

  /// Before a system larger than any before is laid out and factorised. Throws ComputationError, on all ranks, if one
  /// of them may not take the memory. Collective.
  void require_memory_for_unknowns(PetscInt n_unknowns, int dimension, bool iterative, MPI_Comm communicator);
} // namespace swimtwin
