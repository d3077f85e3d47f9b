#include <datasets/tracks/data_problems.h>

#include <tests/datasets/temporary_folder.h>

#include <algorithm>

namespace swimtwin
{
  TEST(DataProblems, TellEachOnce)
  {
    DataProblems problems;
    problems.error("a.csv:3: two columns x.");
    problems.warning("a.csv:3: two columns x.");
    problems.error("a.csv:3: two columns x.");
    EXPECT_EQ(problems.all().size(), 2u);
    EXPECT_EQ(message_of<InputError>([&] { problems.throw_errors(); }), "a.csv:3: two columns x.");
  }

  TEST(DataProblems, TellSomeDozensAtMost)
  {
    DataProblems problems;
    for (int i = 0; i < 1000; ++i)
      problems.error("a.csv:" + std::to_string(i) + ": wrong.");
    const std::string message = message_of<InputError>([&] { problems.throw_errors(); });
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 29);
    expect_in(message, "a.csv:28: wrong.\n... and 971 more errors: correct these first.");
  }
} // namespace swimtwin
