#include <datasets/system/console.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace swimtwin
{
  namespace
  {
    /// The first error of standard output; later ones follow from it.
    int first_loss = 0;

    void note(const bool written)
    {
      if (!written && first_loss == 0)
        first_loss = errno != 0 ? errno : EIO;
    }
  } // namespace

  void say_text(const std::string_view text)
  {
    errno = 0;
    if (first_loss == 0)
      note(std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0);
  }

  void mutter(const std::string_view text)
  {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  }

  void remark(const std::string_view sentence)
  {
    mutter(fmt::format("swimtwin: {}\n", sentence));
  }

  void warn(const std::string_view sentence)
  {
    remark(fmt::format("warning: {}", sentence));
  }

  std::string why_output_was_lost()
  {
    std::clearerr(stdout);
    const int loss = std::exchange(first_loss, 0);
    return loss == 0 || loss == EPIPE ? std::string() : std::generic_category().message(loss);
  }
} // namespace swimtwin
