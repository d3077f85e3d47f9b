// Ranks without MPI: mpirun tells each process its rank before MPI is started.
#include <app/frame/ranks.h>

#include <app/frame/library_environment.h>

#include <chrono>
#include <thread>

namespace swimtwin
{
  bool is_speaker()
  {
    return launched_rank() == 0;
  }

  void agree(const std::function<void()> &on_speaker)
  {
    if (is_speaker())
      on_speaker();
  }

  double of_speaker(const double value)
  {
    return value;
  }

  Ending end_together(const int own_exit_code)
  {
    // All ranks read the same input and find the same mistake: rank 0 speaks, and when it ends mpirun ends the others.
    if (own_exit_code != 0 && !is_speaker())
      std::this_thread::sleep_for(std::chrono::seconds(2));
    return {.exit_code = own_exit_code, .is_to_speak = own_exit_code != 0};
  }

  void end_all_ranks(int /*exit_code*/) {}
} // namespace swimtwin
