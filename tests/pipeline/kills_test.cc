#include <tests/pipeline/killed_runs.h>

// Few of them; tests/stress/kills_test.cc has fifty.
namespace swimtwin
{
  TEST(Kills, LoseNothingBeyondTheLastCheckpoint)
  {
    kill_and_resume(busy_swimmer("none"), 7, 1);
  }

  // Whose checkpoints hold the flow's past.
  TEST(Kills, LoseNothingOfARunWithInertia)
  {
    kill_and_resume(busy_swimmer("full"), 7, 2);
  }
} // namespace swimtwin
