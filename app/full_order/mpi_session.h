// MPI, PETSc and the BLAS for the time of a program.
#pragma once

#include <mpi.h>

#include <memory>

namespace dealii::Utilities::MPI
{
  class MPI_InitFinalize;
}

namespace swimtwin
{
  /// Started once, first thing in main(), and ended last. What the libraries say while they start is held back; if they
  /// cannot be started, the program ends with one sentence and exit code 1.
  class MpiSession
  {
  public:
    MpiSession();
    ~MpiSession();
    MpiSession(const MpiSession &)            = delete;
    MpiSession &operator=(const MpiSession &) = delete;

  private:
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> libraries_;
  };

  /// Of all ranks, for what they say to each other when they end and nothing else.
  MPI_Comm ending_communicator();
} // namespace swimtwin
