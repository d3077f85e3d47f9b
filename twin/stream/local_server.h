// A port of this machine, for one client after the other. Nothing listens beyond it.
#pragma once

#include <string_view>

namespace swimtwin
{
  /// The descriptor of a connection to a port of this machine. Throws InputError if nobody listens there.
  int connect_locally(int port);

  /// A socket that listens on 127.0.0.1; port 0 is any free one, which `found` then names. `option` is what to change
  /// where the port cannot be had, which is an InputError.
  int listen_locally(int port, const char *option, int &found);

  class LocalServer
  {
  public:
    /// Listens on 127.0.0.1; port 0 is any free one. Throws InputError if the port cannot be had.
    explicit LocalServer(int port);
    ~LocalServer();
    LocalServer(const LocalServer &)            = delete;
    LocalServer &operator=(const LocalServer &) = delete;

    int port() const { return port_; }
    /// Whether a client came within the time; the one before is let go.
    bool accept_client(int timeout_ms);
    int  client() const { return client_; }
    void drop_client();
    /// What a client does not take, because it went away, is lost.
    void send(std::string_view text);

  private:
    int socket_ = -1, client_ = -1, port_ = 0;
  };
} // namespace swimtwin
