#include <datasets/system/error.h>
#include <twin/stream/local_socket.h>

#include <fmt/format.h>

#include <arpa/inet.h>
#include <cerrno>
#include <cstdint>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <string>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    int open_socket()
    {
      return ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    }

    sockaddr_in address_of(const int port)
    {
      sockaddr_in address{};
      address.sin_family      = AF_INET;
      address.sin_port        = htons(static_cast<std::uint16_t>(port));
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      return address;
    }

    void switch_on(const int descriptor, const int level, const int option)
    {
      const int yes = 1;
      ::setsockopt(descriptor, level, option, &yes, sizeof(yes));
    }

    /// A line goes out at once, and does not wait for the next.
    void send_at_once(const int descriptor)
    {
      switch_on(descriptor, IPPROTO_TCP, TCP_NODELAY);
    }

    /// Why the last call failed; the descriptor is let go.
    std::string cause_of_failure(const int descriptor)
    {
      std::string cause = std::generic_category().message(errno);
      if (descriptor >= 0)
        ::close(descriptor);
      return cause;
    }
  } // namespace

  ListeningSocket::ListeningSocket(const int port, const char *option) : descriptor_(open_socket())
  {
    sockaddr_in address   = address_of(port);
    auto       *somewhere = reinterpret_cast<sockaddr *>(&address);
    socklen_t   size      = sizeof(address);
    if (descriptor_ >= 0)
      switch_on(descriptor_, SOL_SOCKET, SO_REUSEADDR);
    if (descriptor_ < 0 || ::bind(descriptor_, somewhere, size) != 0 || ::listen(descriptor_, 4) != 0 ||
        ::getsockname(descriptor_, somewhere, &size) != 0)
      throw InputError(fmt::format("cannot listen on port {} of this machine: {}; choose another {}.", port,
                                   cause_of_failure(descriptor_), option));
    port_ = ntohs(address.sin_port);
  }

  ListeningSocket::~ListeningSocket()
  {
    ::close(descriptor_);
  }

  int ListeningSocket::accept(const int flags) const
  {
    const int client = ::accept4(descriptor_, nullptr, nullptr, SOCK_CLOEXEC | flags);
    if (client >= 0)
      send_at_once(client);
    return client;
  }

  int connect_locally(const int port)
  {
    const sockaddr_in address    = address_of(port);
    const int         descriptor = open_socket();
    if (descriptor < 0 || ::connect(descriptor, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0)
      throw InputError(
          fmt::format("cannot connect to port {} of this machine: {}; start `swimtwin twin ... --listen {}` "
                      "first.",
                      port, cause_of_failure(descriptor), port));
    send_at_once(descriptor);
    return descriptor;
  }
} // namespace swimtwin
