// A port of this machine, for one client after the other.
#pragma once

#include <twin/stream/local_socket.h>

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
    /// What a client does not take, because it went away, is lost.
    void send(std::string_view text);

  private:
    ListeningSocket socket_;
    int             client_ = -1;
  };
} // namespace swimtwin
