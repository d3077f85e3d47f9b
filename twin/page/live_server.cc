#include <datasets/system/error.h>
#include <twin/page/live_server.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    constexpr std::size_t most_clients = 16, longest_request = 8192, most_waiting = 1 << 20;

    std::string event(const std::string &line)
    {
      return "data: " + line + "\n\n";
    }

    std::string response(const char *status, const char *type, const std::string &body)
    {
      return fmt::format("HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n"
                         "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
                         "Content-Security-Policy: default-src 'none'; script-src 'unsafe-inline'; style-src "
                         "'unsafe-inline'; connect-src 'self'; frame-ancestors 'none'\r\n\r\n{}",
                         status, type, body.size(), body);
    }

    /// Value of a header, without its spaces; empty without one.
    std::string header(const std::string &request, const std::string &name)
    {
      std::string lower = request;
      std::transform(lower.begin(), lower.end(), lower.begin(), [](const unsigned char c) { return std::tolower(c); });
      const std::size_t at = lower.find("\r\n" + name + ":");
      if (at == std::string::npos)
        return "";
      const std::size_t begin = lower.find_first_not_of(' ', at + name.size() + 3), end = lower.find("\r\n", at + 2);
      return begin < end ? lower.substr(begin, end - begin) : "";
    }
  } // namespace

  LiveServer::LiveServer(const int port, std::string page) : page_(std::move(page)), socket_(port, "--page")
  {
    if (::pipe2(wake_, O_CLOEXEC | O_NONBLOCK) != 0)
      throw ComputationError("cannot make a pipe for the live page; close other programs.");
    thread_ = std::thread([this] { serve(); });
  }

  LiveServer::~LiveServer()
  {
    is_over_ = true;
    static_cast<void>(::write(wake_[1], "x", 1) < 0);
    thread_.join();
    for (const Client &client : clients_)
      ::close(client.socket);
    for (const int descriptor : wake_)
      ::close(descriptor);
  }

  void LiveServer::publish(const std::string &line)
  {
    const std::lock_guard lock(mutex_);
    news_.push_back(event(line));
    static_cast<void>(::write(wake_[1], "x", 1) < 0); // a full pipe wakes as well
  }

  void LiveServer::publish_for_ever(const std::string &line)
  {
    const std::lock_guard lock(mutex_);
    news_.push_back(event(line));
    if (std::find(lasting_.begin(), lasting_.end(), event(line)) == lasting_.end())
      lasting_.push_back(event(line));
    static_cast<void>(::write(wake_[1], "x", 1) < 0);
  }

  /// Another site's script that names this machine gives its own name as the host: it is turned away.
  std::string LiveServer::answer(const std::string &request, bool &listens) const
  {
    const std::string host = header(request, "host");
    if (host != fmt::format("127.0.0.1:{}", port()) && host != fmt::format("localhost:{}", port()))
      return response("403 Forbidden", "text/plain", "This page is for this machine only: open http://127.0.0.1.\n");
    if (!request.starts_with("GET "))
      return response("405 Method Not Allowed", "text/plain", "This page can only be looked at.\n");
    const std::string path = request.substr(4, request.find(' ', 4) - 4);
    if (path == "/")
      return response("200 OK", "text/html; charset=utf-8", page_);
    if (path != "/events")
      return response("404 Not Found", "text/plain", "There is \"/\" and \"/events\".\n");
    listens = true;
    return "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\n"
           "X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n";
  }

  void LiveServer::accept_client()
  {
    const int client = socket_.accept(SOCK_NONBLOCK);
    if (client < 0)
      return;
    if (clients_.size() >= most_clients)
      ::close(client);
    else
      clients_.push_back({client, {}, {}, false, false});
  }

  void LiveServer::read_request(Client &client) const
  {
    char          bytes[2048];
    const ssize_t n = ::read(client.socket, bytes, sizeof(bytes));
    if (n < 0 && (errno == EAGAIN || errno == EINTR))
      return;
    if (n <= 0 || client.request.size() > longest_request)
    {
      client.is_done = true;
      client.waiting.clear();
      client.listens = false;
      return;
    }
    if (client.listens || client.is_done)
      return; // nothing more is asked
    client.request.append(bytes, static_cast<std::size_t>(n));
    if (client.request.find("\r\n\r\n") == std::string::npos)
      return;
    client.waiting = answer(client.request, client.listens);
    client.is_done = !client.listens;
    client.request.clear();
  }

  void LiveServer::write(Client &client)
  {
    const ssize_t n = ::send(client.socket, client.waiting.data(), client.waiting.size(), MSG_NOSIGNAL);
    if (n > 0)
      client.waiting.erase(0, static_cast<std::size_t>(n));
    else if (errno != EAGAIN && errno != EINTR)
    {
      client.waiting.clear();
      client.listens = false;
      client.is_done = true;
    }
  }

  void LiveServer::hand_out()
  {
    const std::lock_guard lock(mutex_);
    for (const std::string &news : news_)
      for (Client &client : clients_)
        if (client.listens)
          client.waiting += news;
    news_.clear();
  }

  void LiveServer::serve()
  {
    while (!is_over_)
    {
      std::vector<pollfd> wanted = {{socket_.descriptor(), POLLIN, 0}, {wake_[0], POLLIN, 0}};
      for (const Client &client : clients_)
        wanted.push_back({client.socket, static_cast<short>(client.waiting.empty() ? POLLIN : POLLIN | POLLOUT), 0});
      if (::poll(wanted.data(), wanted.size(), -1) < 0)
        continue;
      for (char bytes[256]; ::read(wake_[0], bytes, sizeof(bytes)) > 0;)
        ;
      hand_out();
      for (std::size_t i = 0; i < clients_.size(); ++i)
        if ((wanted[i + 2].revents & (POLLIN | POLLHUP | POLLERR)) != 0)
        {
          const bool listened = clients_[i].listens;
          read_request(clients_[i]);
          const std::lock_guard lock(mutex_);
          if (clients_[i].listens && !listened)
            for (const std::string &line : lasting_)
              clients_[i].waiting += line;
        }
      for (Client &client : clients_)
        if (!client.waiting.empty())
          write(client);
      if ((wanted[0].revents & POLLIN) != 0)
        accept_client();
      std::erase_if(clients_, [](const Client &client) {
        const bool is_gone = (client.is_done && client.waiting.empty()) || client.waiting.size() > most_waiting;
        if (is_gone)
          ::close(client.socket);
        return is_gone;
      });
    }
  }
} // namespace swimtwin
