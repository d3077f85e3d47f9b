#include <twin/stream/local_server.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <poll.h>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    class Client
    {
    public:
      explicit Client(LocalServer &server) : descriptor_(connect_locally(server.port()))
      {
        EXPECT_TRUE(server.accept_client(1000));
      }
      ~Client() { ::close(descriptor_); }
      Client(const Client &)            = delete;
      Client &operator=(const Client &) = delete;

      /// All that is there now.
      std::string read()
      {
        std::string             text;
        std::array<char, 65536> bytes{};
        for (pollfd there{descriptor_, POLLIN, 0}; ::poll(&there, 1, 50) > 0;)
        {
          const ssize_t n = ::read(descriptor_, bytes.data(), bytes.size());
          if (n <= 0)
            break;
          text.append(bytes.data(), static_cast<std::size_t>(n));
        }
        return text;
      }

    private:
      int descriptor_;
    };

    std::string numbered(const int i)
    {
      return fmt::format("{:0>999}\n", i);
    }
  } // namespace

  TEST(LocalServer, DoesNotWaitForeverForAClientThatNeverReads)
  {
    LocalServer server(0);
    Client      client(server);
    int         n = 0;
    for (; server.n_lost() == 0 && n < 100'000; ++n)
      server.send(numbered(n));
    ASSERT_GT(server.n_lost(), 0);
    server.send(numbered(n++)); // at once
    // It reads again: whole lines in order up to the first that was lost, and what is sent from now on.
    std::string text = client.read();
    server.send(numbered(n++));
    const long n_lost = server.n_lost();
    server.send(numbered(n++));
    EXPECT_EQ(server.n_lost(), n_lost);
    text += client.read();
    ASSERT_EQ(text.size() % 1000, 0u);
    int last = -1;
    for (std::size_t at = 0; at < text.size(); at += 1000)
    {
      const int i = std::stoi(text.substr(at, 999));
      EXPECT_GT(i, last);
      last = i;
    }
    EXPECT_EQ(last, n - 1);
    EXPECT_EQ(static_cast<long>(text.size() / 1000) + n_lost, n);
  }

  TEST(LocalServer, WaitsForOneThatIsSlow)
  {
    LocalServer server(0);
    Client      client(server);
    std::string text;
    for (int i = 0; i < 20'000; ++i)
    {
      server.send(numbered(i));
      if (i % 500 == 499)
        text += client.read();
    }
    text += client.read();
    EXPECT_EQ(server.n_lost(), 0);
    EXPECT_EQ(text.size(), 20'000'000u);
  }

  TEST(LocalServer, ForgetsWhatAClientThatWentAwayDidNotTake)
  {
    LocalServer server(0);
    {
      const Client gone(server);
    }
    for (int i = 0; i < 10; ++i)
      server.send(numbered(i));
    Client next(server);
    server.send(numbered(7));
    EXPECT_EQ(next.read(), numbered(7));
  }
} // namespace swimtwin
