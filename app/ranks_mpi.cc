#include <app/ranks.h>

#include <datasets/error.h>

#include <mpi.h>

#include <chrono>
#include <string>
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

  void agree(const std::function<void()> &on_speaker)
  {
    std::string refusal;
    if (is_speaker())
      try
      {
        on_speaker();
      }
      catch (const InputError &error)
      {
        refusal = error.what();
      }
    auto size = static_cast<unsigned long>(refusal.size());
    MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
    refusal.resize(size);
    MPI_Bcast(refusal.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
    if (!refusal.empty())
      throw InputError(refusal);
  }

  void end_all_ranks(const int exit_code)
  {
    int n_ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    if (n_ranks > 1)
      MPI_Abort(MPI_COMM_WORLD, exit_code);
  }
} // namespace swimtwin
