// What other programs' libraries are told by the environment: nothing but what the tool wants.
#pragma once

#include <string>

namespace swimtwin
{
  enum class RanksAtWork {
    all,     ///< those that mpirun started work together
    this_one ///< the others have nothing to do, and are not waited for
  };

  /// Rank that mpirun (or another launcher that speaks PMIx) gave this process; 0 without one.
  int launched_rank();

  /// Of several tasks that MPI cannot bring together ("srun"); empty if there are none.
  std::string unknown_launcher();

  /// Take out of the environment what could break or change the libraries: options of PETSc, thread numbers, debugging
  /// of HDF5, kernels of the BLAS that this processor cannot run. One thread per rank. What a machine may need stays:
  /// HDF5_USE_FILE_LOCKING, and kernels that it can run.
  void quiet_library_environment();

  /// The same for MPI, before it starts: a process that works alone needs no daemon, no ssh, no folder for temporary
  /// files, no network, nobody's settings, and no allocation that it runs in. One that works with others keeps what
  /// mpirun told it.
  void settle_mpi_environment(RanksAtWork ranks);
} // namespace swimtwin
