#include <app/full_order/mpi_session.h>

#include <app/frame/library_environment.h>
#include <app/full_order/blas_buffer.h>
#include <app/full_order/library_start.h>

#include <deal.II/base/mpi.h>
#include <petscsys.h>

#include <exception>

namespace swimtwin
{
  namespace
  {
    MPI_Comm ending = MPI_COMM_NULL;

    /// PETSc reads no options but these: not ours, no .petscrc. Its errors come back as codes, signals as signals.
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> start_libraries()
    {
      static char  name[] = "swimtwin", no_file[] = "-skip_petscrc", no_handler[] = "-no_signal_handler";
      static char *words[] = {name, no_file, no_handler, nullptr};
      int          n       = 3;
      char       **first   = words;
      auto         started = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(n, first, 1);
      PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
      MPI_Comm_dup(MPI_COMM_WORLD, &ending);
      return started;
    }
  } // namespace

  MpiSession::MpiSession()
  {
    quiet_library_environment();
    settle_mpi_environment(RanksAtWork::all);
    take_blas_buffer();
    const LibraryStart start;
    try
    {
      libraries_ = start_libraries();
    }
    catch (const std::exception &)
    {
      LibraryStart::give_up();
    }
  }

  MpiSession::~MpiSession()
  {
    MPI_Comm_free(&ending);
  }

  MPI_Comm ending_communicator()
  {
    return ending;
  }
} // namespace swimtwin
