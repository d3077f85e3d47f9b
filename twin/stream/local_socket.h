// Sockets of this machine: who listens, and who connects. Nothing listens beyond it.
#pragma once

namespace swimtwin
{
  /// Listens on 127.0.0.1 as long as it lives.
  class ListeningSocket
  {
  public:
    /// Port 0 is any free one. Throws InputError, with the option to change, if the port cannot be had.
    ListeningSocket(int port, const char *option);
    ~ListeningSocket();
    ListeningSocket(const ListeningSocket &)            = delete;
    ListeningSocket &operator=(const ListeningSocket &) = delete;

    int descriptor() const { return descriptor_; }
    int port() const { return port_; }
    /// The descriptor of the client that knocked, which is the caller's; negative without one. `flags` as of accept4.
    int accept(int flags = 0) const;

  private:
    int descriptor_ = -1, port_ = 0;
  };

  /// The descriptor of a connection to a port of this machine. Throws InputError if nobody listens there.
  int connect_locally(int port);
} // namespace swimtwin
