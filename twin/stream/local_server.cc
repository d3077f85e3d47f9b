#include <twin/stream/local_server.h>

#include <cerrno>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace swimtwin
{
  LocalServer::LocalServer(const int port) : socket_(port, "--listen") {}

  LocalServer::~LocalServer()
  {
    drop_client();
  }

  void LocalServer::drop_client()
  {
    if (client_ >= 0)
      ::close(client_);
    client_ = -1;
  }

  bool LocalServer::accept_client(const int timeout_ms)
  {
    pollfd wanted{socket_.descriptor(), POLLIN, 0};
    if (::poll(&wanted, 1, timeout_ms) <= 0)
      return false;
    const int client = socket_.accept();
    if (client < 0)
      return false;
    drop_client();
    client_ = client;
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
