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
    rest_.clear();
    is_deaf_ = false;
    n_lost_  = 0;
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

  /// How much of it was taken; of one that went away, all.
  std::size_t LocalServer::send_part(const std::string_view text, const std::chrono::milliseconds wait)
  {
    std::size_t n_taken = 0;
    while (n_taken < text.size())
    {
      const ssize_t n = ::send(client_, text.data() + n_taken, text.size() - n_taken, MSG_NOSIGNAL | MSG_DONTWAIT);
      pollfd        wanted{client_, POLLOUT, 0};
      if (n >= 0)
        n_taken += static_cast<std::size_t>(n);
      else if (errno == EAGAIN || errno == EWOULDBLOCK)
      {
        if (::poll(&wanted, 1, static_cast<int>(wait.count())) == 0)
          return n_taken;
      }
      else if (errno != EINTR)
        return text.size();
    }
    return n_taken;
  }

  void LocalServer::send(const std::string_view line)
  {
    if (client_ < 0)
      return;
    const auto wait = is_deaf_ ? std::chrono::milliseconds(0) : patience;
    rest_.erase(0, send_part(rest_, wait));
    const std::size_t n_taken = rest_.empty() ? send_part(line, wait) : 0;
    is_deaf_                  = n_taken < line.size();
    if (n_taken > 0)
      rest_ = line.substr(n_taken);
    else
      ++n_lost_;
  }
} // namespace swimtwin
