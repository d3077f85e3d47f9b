#include <datasets/system/error.h>
#include <twin/lab/lab_link.h>
#include <twin/stream/local_socket.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    constexpr int answer_within_ms = 20000;

    bool is_over(const LineReader::Got got)
    {
      return got == LineReader::Got::end || got == LineReader::Got::nothing;
    }

    int open_commands(const std::filesystem::path &file)
    {
      const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
      if (descriptor < 0)
        throw InputError(fmt::format("cannot read {}: {}; make it with mkfifo, and let the twin write into it.",
                                     file.string(), std::generic_category().message(errno)));
      return descriptor;
    }
  } // namespace

  LabLink::LabLink(const int port) : in_(connect_locally(port)), out_(in_), reader_(in_) {}

  LabLink::LabLink(const std::filesystem::path &commands)
      : in_(open_commands(commands)), out_(STDOUT_FILENO), reader_(in_)
  {
    std::signal(SIGPIPE, SIG_IGN); // a twin that went away is an answer of send()
  }

  LabLink::~LabLink()
  {
    ::close(in_);
  }

  bool LabLink::send(const std::string &line)
  {
    const std::string whole = line + '\n';
    std::size_t       done  = 0;
    while (done < whole.size())
    {
      const ssize_t n = out_ == STDOUT_FILENO ? ::write(out_, whole.data() + done, whole.size() - done)
                                              : ::send(out_, whole.data() + done, whole.size() - done, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR)
        continue;
      if (n <= 0)
        return false;
      done += static_cast<std::size_t>(n);
    }
    return true;
  }

  void LabLink::finish()
  {
    if (!send(R"({"type":"end"})"))
      return;
    if (out_ == STDOUT_FILENO)
      ::close(out_);
    for (std::string line; !has_ended_;)
      has_ended_ = is_over(reader_.next(line, answer_within_ms));
  }

  std::vector<PlayMessage> LabLink::hear(const double clock_s, const bool waits)
  {
    std::vector<PlayMessage> plays;
    for (std::string line; !has_ended_;)
      switch (reader_.next(line, waits ? answer_within_ms : 0))
      {
      case LineReader::Got::line: {
        const auto        json = nlohmann::json::parse(line, nullptr, false);
        const std::string type = json.is_object() ? json.value("type", "") : "";
        if (type == "play")
          plays.push_back(std::get<PlayMessage>(parse_message(line, {})));
        if (waits && type == "clock" && json.value("time_s", -1.) == clock_s)
          return plays;
        break;
      }
      case LineReader::Got::too_long:
        break;
      case LineReader::Got::nothing:
        if (waits)
          throw ComputationError(fmt::format("the twin has not answered the clock's line of {:.6g} s for {} s.",
                                             clock_s, answer_within_ms / 1000));
        return plays;
      case LineReader::Got::end:
        has_ended_ = true;
        break;
      }
    return plays;
  }
} // namespace swimtwin
