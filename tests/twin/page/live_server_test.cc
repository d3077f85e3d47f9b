#include <twin/page/live_server.h>
#include <twin/stream/local_socket.h>

#include <datasets/system/error.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    class Browser
    {
    public:
      Browser(const LiveServer &server, const std::string &request) : socket_(connect_locally(server.port()))
      {
        EXPECT_EQ(::send(socket_, request.data(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
      }
      ~Browser() { ::close(socket_); }
      Browser(const Browser &)            = delete;
      Browser &operator=(const Browser &) = delete;

      /// Until the answer has this in it or ends, at most five seconds.
      const std::string &read_until(const std::string &wanted)
      {
        while (got_.find(wanted) == std::string::npos)
        {
          pollfd readable{socket_, POLLIN, 0};
          char   bytes[4096];
          if (::poll(&readable, 1, 5000) <= 0)
            break;
          const ssize_t n = ::read(socket_, bytes, sizeof(bytes));
          if (n <= 0)
          {
            has_ended_ = true;
            break;
          }
          got_.append(bytes, static_cast<std::size_t>(n));
        }
        return got_;
      }
      bool has_ended() const { return has_ended_; }

    private:
      int         socket_;
      std::string got_;
      bool        has_ended_ = false;
    };

    std::string get(const LiveServer &server, const std::string &path, const std::string &host = "127.0.0.1",
                    const std::string &verb = "GET")
    {
      return fmt::format("{} {} HTTP/1.1\r\nHost: {}:{}\r\n\r\n", verb, path, host, server.port());
    }

    TEST(LiveServer, ServesThePageAndEventsAsTheyCome)
    {
      LiveServer server(0, "<p>the page</p>");
      Browser    page(server, get(server, "/"));
      EXPECT_NE(page.read_until("the page</p>").find("200 OK"), std::string::npos);
      server.publish_for_ever(R"({"type":"twin"})");
      Browser early(server, get(server, "/events", "localhost"));
      early.read_until("data: {\"type\":\"twin\"}\n\n");
      server.publish(R"({"type":"view"})");
      EXPECT_NE(early.read_until("view").find("data: {\"type\":\"view\"}\n\n"), std::string::npos);
      Browser late(server, get(server, "/events"));
      EXPECT_NE(late.read_until("twin\"}").find("data: {\"type\":\"twin\"}\n\n"), std::string::npos);
    }

    TEST(LiveServer, TurnsAwayWhatItDoesNotServe)
    {
      const LiveServer server(0, "<p>the page</p>");
      EXPECT_NE(Browser(server, get(server, "/", "evil.example")).read_until("403").find("403"), std::string::npos);
      EXPECT_NE(Browser(server, "GET / HTTP/1.1\r\n\r\n").read_until("403").find("403"), std::string::npos);
      EXPECT_NE(Browser(server, get(server, "/", "127.0.0.1", "POST")).read_until("405").find("405"),
                std::string::npos);
      EXPECT_NE(Browser(server, get(server, "/../etc/passwd")).read_until("404").find("404"), std::string::npos);
      Browser endless(server, std::string(60000, 'x'));
      endless.read_until("never");
      EXPECT_TRUE(endless.has_ended());
    }

    TEST(LiveServer, IsNotHeldUpByWhoDoesNotRead)
    {
      LiveServer        server(0, "");
      Browser           asleep(server, get(server, "/events")), awake(server, get(server, "/events"));
      const std::string line(10000, 'x');
      awake.read_until("\r\n\r\n");
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < 2000; ++i)
        server.publish(line);
      EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
      Browser after(server, get(server, "/"));
      EXPECT_NE(after.read_until("200").find("200"), std::string::npos);
    }

    TEST(LiveServer, SaysThatAPortIsTaken)
    {
      const LiveServer first(0, "");
      try
      {
        const LiveServer second(first.port(), "");
        ADD_FAILURE() << "listens twice";
      }
      catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("choose another --page"), std::string::npos) << error.what();
      }
    }
  } // namespace
} // namespace swimtwin
