#include <app/ranks.h>

#include <mpi.h>

#include <chrono>
#include <thread>

namespace swimtwin
{
  bool is_speaker()
  {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == 0;
  }

  void let_speaker_go_first()
  {
    if (!is_speaker())
      std::this_thread::sleep_for(std::chrono::seconds(2));
  }

  void end_all_ranks(const int exit_code)
  {
    int n_ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    if (n_ranks > 1)
      MPI_Abort(MPI_COMM_WORLD, exit_code);
  }
} // namespace swimtwin
