// The live page: a few people on this machine look on in their browsers. Nothing listens beyond it.
#pragma once

#include <twin/stream/local_socket.h>

#include <atomic>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace swimtwin
{
  /// Serves "/", the page, and "/events", lines as server-sent events, on 127.0.0.1. A thread of its own: who looks on
  /// slowly, or not at all, never holds up the twin.
  class LiveServer
  {
  public:
    /// Port 0 is any free one. Throws InputError if the port cannot be had.
    LiveServer(int port, std::string page);
    ~LiveServer();
    LiveServer(const LiveServer &)            = delete;
    LiveServer &operator=(const LiveServer &) = delete;

    int port() const { return socket_.port(); }
    /// To all who look on.
    void publish(const std::string &line);
    /// The same, and to those who come later, before everything else.
    void publish_for_ever(const std::string &line);

  private:
    struct Client
    {
      int         socket = -1;
      std::string request, waiting; ///< as far as it has come; what it has not taken yet
      bool        listens = false, is_done = false;
    };

    void        serve();
    void        accept_client();
    void        read_request(Client &client) const;
    std::string answer(const std::string &request, bool &listens) const;
    void        hand_out();
    static void write(Client &client);

    std::string              page_;
    ListeningSocket          socket_;
    int                      wake_[2] = {-1, -1};
    std::vector<Client>      clients_; ///< of the thread
    std::mutex               mutex_;
    std::deque<std::string>  news_; ///< not handed out yet
    std::vector<std::string> lasting_;
    std::atomic<bool>        is_over_ = false;
    std::thread              thread_;
  };
} // namespace swimtwin
