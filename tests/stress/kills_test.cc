#include <tests/pipeline/killed_runs.h>

namespace swimtwin
{
  TEST(FiftyKills, LoseNothingBeyondTheLastCheckpoint)
  {
    kill_and_resume(busy_swimmer("none"), 25, 11);
  }

  TEST(FiftyKills, LoseNothingOfARunWithInertia)
  {
    kill_and_resume(busy_swimmer("full"), 25, 12);
  }
} // namespace swimtwin
