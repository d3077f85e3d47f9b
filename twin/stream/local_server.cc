#include <datasets/system/error.h>
#include <twin/stream/local_server.h>

#include <fmt/format.h>

#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    [[noreturn]] void refuse_port(const int port, const char *option)
    {
      const std::string cause = std::generic_category().message(errno);
      throw InputError(
          fmt::format("cannot listen on port {} of this machine: {}; choose another {}.", port, cause, option));
    }
  } // namespace

  int connect_locally(const int port)
  {
    sockaddr_in address{};
    address.sin_family      = AF_INET;
    address.sin_port        = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int descriptor    = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0 || ::connect(descriptor, reinterpret_cast<sockaddr *>(&address), sizeof(address)) != 0)
    {
      const std::string cause = std::generic_category().message(errno);
      if (descriptor >= 0)
        ::close(descriptor);
      throw InputError(
          fmt::format("cannot connect to port {} of this machine: {}; start `swimtwin twin ... --listen {}` "
                      "first.",
                      port, cause, port));
    }
    const int yes = 1;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    return descriptor;
  }

  int listen_locally(const int port, const char *option, int &found)
  {
    const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0)
      refuse_port(port, option);
    const int yes = 1;
    ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    sockaddr_in address{};
    address.sin_family      = AF_INET;
    address.sin_port        = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size          = sizeof(address);
    if (::bind(descriptor, reinterpret_cast<sockaddr *>(&address), size) != 0 || ::listen(descriptor, 4) != 0 ||
        ::getsockname(descriptor, reinterpret_cast<sockaddr *>(&address), &size) != 0)
    {
      const int cause = errno;
      ::close(descriptor);
      errno = cause;
      refuse_port(port, option);
    }
    found = ntohs(address.sin_port);
    return descriptor;
  }

  LocalServer::LocalServer(const int port)
  {
    socket_ = listen_locally(port, "--listen", port_);
  }

  LocalServer::~LocalServer()
  {
    drop_client();
    ::close(socket_);
  }

  void LocalServer::drop_client()
  {
    if (client_ >= 0)
      ::close(client_);
    client_ = -1;
  }

  bool LocalServer::accept_client(const int timeout_ms)
  {
    pollfd wanted{socket_, POLLIN, 0};
    if (::poll(&wanted, 1, timeout_ms) <= 0)
      return false;
    const int client = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0)
      return false;
    drop_client();
    client_       = client;
    const int yes = 1;
    ::setsockopt(client_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    return true;
  }

  void LocalServer::send(std::string_view text)
  {
    while (client_ >= 0 && !text.empty())
    {
      const ssize_t n = ::send(client_, text.data(), text.size(), MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR)
        continue;
      if (n <= 0)
        return;
      text.remove_prefix(static_cast<std::size_t>(n));
    }
  }
} // namespace swimtwin
