#include <datasets/system/console.h>

#include <algorithm>
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
    bool is_obeyed(const char c)
    {
      return (c >= 0 && c < ' ' && c != '\n' && c != '\t') || c == 0x7f;
    }

    /// Cut between letters of UTF-8.
    std::string shortened(const std::string_view line)
    {
      constexpr std::size_t longest = 4000, n_head = 600, n_tail = 300;
      if (line.size() <= longest)
        return std::string(line);
      const auto  is_inside = [&](const std::size_t i) { return (static_cast<unsigned char>(line[i]) & 0xC0) == 0x80; };
      std::size_t head = n_head, tail = line.size() - n_tail;
      while (head > 0 && is_inside(head))
        --head;
      while (tail < line.size() && is_inside(tail))
        ++tail;
      return fmt::format("{} ... ({} bytes are left out) ... {}", line.substr(0, head), tail - head, line.substr(tail));
    }
  } // namespace

  std::string displayable(const std::string_view text)
  {
    std::string result;
    for (std::size_t begin = 0; begin <= text.size();)
    {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      for (const char c : shortened(text.substr(begin, end - begin)))
        result += is_obeyed(c) ? fmt::format("\\x{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
      if (end < text.size())
        result += '\n';
      begin = end + 1;
    }
    return result;
  }

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
    mutter(fmt::format("swimtwin: {}\n", displayable(sentence)));
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
