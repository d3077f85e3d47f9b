#include <twin/stream/line_reader.h>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <poll.h>
#include <unistd.h>

namespace swimtwin
{
  std::string LineReader::too_long_sentence()
  {
    return fmt::format("the line is longer than {} bytes and was thrown away; send frames with fewer points, each on a "
                       "line of its own.",
                       most_bytes);
  }

  /// False if nothing came in time.
  bool LineReader::fill(const int timeout_ms)
  {
    pollfd    wanted{descriptor_, POLLIN, 0};
    const int ready = ::poll(&wanted, 1, timeout_ms);
    if (ready <= 0)
      return false;
    std::array<char, 16384> bytes{};
    const ssize_t           n = ::read(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && (errno == EINTR || errno == EAGAIN))
      return false;
    if (n <= 0) // a broken connection ends like one that was closed
      has_ended_ = true;
    else
      buffer_.append(bytes.data(), static_cast<std::size_t>(n));
    return true;
  }

  LineReader::Got LineReader::next(std::string &line, const int timeout_ms)
  {
    for (;;)
    {
      const std::size_t end = buffer_.find('\n', begin_ + searched_);
      if (end != std::string::npos)
      {
        const bool was_skipping = is_skipping_, fits = end - begin_ <= most_bytes;
        if (!was_skipping && fits)
          line.assign(buffer_, begin_, end - begin_);
        begin_       = end + 1;
        searched_    = 0;
        is_skipping_ = false;
        if (was_skipping)
          return Got::too_long;
        return fits ? Got::line : Got::too_long;
      }
      buffer_.erase(0, begin_);
      begin_    = 0;
      searched_ = buffer_.size();
      if (buffer_.size() > most_bytes)
      {
        buffer_.clear();
        searched_    = 0;
        is_skipping_ = true;
      }
      if (has_ended_)
      {
        if (is_skipping_)
        {
          is_skipping_ = false;
          buffer_.clear();
          return Got::too_long;
        }
        if (buffer_.empty())
          return Got::end;
        line = std::move(buffer_);
        buffer_.clear();
        searched_ = 0;
        return Got::line;
      }
      if (!fill(timeout_ms))
        return Got::nothing;
    }
  }
} // namespace swimtwin
