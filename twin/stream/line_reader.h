// Lines from a file descriptor, whatever comes through it.
#pragma once

#include <cstddef>
#include <string>

namespace swimtwin
{
  class LineReader
  {
  public:
    static constexpr std::size_t most_bytes = 65536;
    /// What is wrong with a longer line, and what to do.
    static std::string too_long_sentence();

    enum class Got {
      line,
      too_long, ///< thrown away up to its line break
      nothing,  ///< within the time
      end
    };

    /// The descriptor stays the caller's.
    explicit LineReader(const int descriptor) : descriptor_(descriptor) {}

    /// The next line without its break; a last one without a break counts. Waits for at most `timeout_ms`, for ever if
    /// it is negative.
    Got next(std::string &line, int timeout_ms);

  private:
    bool        fill(int timeout_ms);
    int         descriptor_;
    std::string buffer_;
    std::size_t begin_ = 0, searched_ = 0;
    bool        has_ended_ = false, is_skipping_ = false;
  };
} // namespace swimtwin
