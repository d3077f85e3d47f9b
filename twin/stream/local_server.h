// A port of this machine, for one client after the other.
#pragma once

#include <twin/stream/local_socket.h>

#include <chrono>
#include <string>
#include <string_view>

namespace swimtwin
{
  class LocalServer
  {
  public:
    /// Listens on 127.0.0.1; port 0 is any free one. Throws InputError if the port cannot be had.
    explicit LocalServer(int port);
    ~LocalServer();
    LocalServer(const LocalServer &)            = delete;
    LocalServer &operator=(const LocalServer &) = delete;

    int port() const { return socket_.port(); }
    /// Whether a client came within the time; the one before is let go.
    bool accept_client(int timeout_ms);
    int  client() const { return client_; }
    void drop_client();
    /// A line with its line break. It is lost if the client went away, or has taken nothing for `patience`, until it
    /// takes something again.
    void send(std::string_view line);
    /// Lines that the present client did not take in time.
    long n_lost() const { return n_lost_; }

    static constexpr std::chrono::milliseconds patience{1000};

  private:
    std::size_t send_part(std::string_view text, std::chrono::milliseconds wait);

    ListeningSocket socket_;
    int             client_ = -1;
    std::string     rest_; ///< of a line that the client has taken a part of
    bool            is_deaf_ = false;
    long            n_lost_  = 0;
  };
} // namespace swimtwin
