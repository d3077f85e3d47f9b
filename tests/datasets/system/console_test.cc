#include <datasets/system/console.h>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace swimtwin
{
  namespace
  {
    /// Another file in the place of a stream, as long as a test.
    class Redirection
    {
    public:
      Redirection(const int stream, const int target) : stream_(stream), kept_(dup(stream))
      {
        dup2(target, stream);
        close(target);
      }
      Redirection(const Redirection &)            = delete;
      Redirection &operator=(const Redirection &) = delete;
      ~Redirection()
      {
        dup2(kept_, stream_);
        close(kept_);
      }

    private:
      int stream_, kept_;
    };
  } // namespace

  TEST(Console, WritesOutWhatATerminalWouldObey)
  {
    EXPECT_EQ(displayable("cell \"\x1B[2J\" of \xC2\xB5m,\r\x7F\nnext\tline"),
              "cell \"\\x1B[2J\" of \xC2\xB5m,\\x0D\\x7F\nnext\tline");
    EXPECT_EQ(displayable(std::string("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(displayable(""), "");
    EXPECT_EQ(displayable("one\n"), "one\n");
  }

  TEST(Console, LeavesTheEndsOfAnEndlessLine)
  {
    const std::string shown = displayable("head " + std::string(100000, 'x') + " tail\nanother line");
    EXPECT_LT(shown.size(), 1100u);
    EXPECT_TRUE(shown.starts_with("head xxx"));
    EXPECT_TRUE(shown.ends_with(" tail\nanother line"));
    EXPECT_NE(shown.find("bytes are left out"), std::string::npos);
  }

  TEST(Console, RemembersOnceThatOutputWasLost)
  {
    {
      const Redirection full(STDOUT_FILENO, open("/dev/full", O_WRONLY));
      say("{} of {}\n", 1, 2);
      say_text("more\n");
    }
    EXPECT_EQ(why_output_was_lost(), "No space left on device");
    EXPECT_EQ(why_output_was_lost(), "");
    say("what is said afterwards is said\n");
    EXPECT_EQ(why_output_was_lost(), "");
  }

  TEST(Console, AReaderThatWantsNoMoreIsNoLoss)
  {
    std::signal(SIGPIPE, SIG_IGN);
    std::array<int, 2> pipe_ends{};
    ASSERT_EQ(pipe(pipe_ends.data()), 0);
    close(pipe_ends[0]);
    {
      const Redirection gone(STDOUT_FILENO, pipe_ends[1]);
      say_text("nobody listens\n");
    }
    EXPECT_EQ(why_output_was_lost(), "");
  }

  TEST(Console, WarningsNobodyCanReadAreNoFailure)
  {
    const Redirection full(STDERR_FILENO, open("/dev/full", O_WRONLY));
    EXPECT_NO_THROW(warn("of nothing"));
    EXPECT_NO_THROW(remark("nothing"));
    EXPECT_EQ(why_output_was_lost(), "");
  }
} // namespace swimtwin
