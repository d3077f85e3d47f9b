#include <datasets/surface/surface_words.h>

#include <datasets/files/input_file.h>
#include <datasets/text/text_line.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    bool is_blank(const char letter)
    {
      return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n' || letter == '\f' || letter == '\v';
    }

    std::string shown(const std::string_view word)
    {
      constexpr std::size_t longest = 40;
      return text_line(std::string(word.substr(0, longest)));
    }
  } // namespace

  bool equal_but_for_case(const std::string_view a, const std::string_view b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const unsigned char x, const unsigned char y) { return std::tolower(x) == std::tolower(y); });
  }

  std::string_view SurfaceWords::next()
  {
    while (at_ < text_.size() && is_blank(text_[at_]))
      line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view SurfaceWords::needed()
  {
    const std::string_view word = next();
    if (word.empty())
      refuse("the file ends here, in mid-surface; copy or export it again");
    return word;
  }

  void SurfaceWords::expect(const std::string_view word)
  {
    if (const std::string_view found = needed(); !equal_but_for_case(found, word))
      refuse(fmt::format("\"{}\" stands where \"{}\" belongs; export the surface again", shown(found), word));
  }

  double SurfaceWords::number()
  {
    std::string_view word = needed();
    if (word.starts_with('+'))
      word.remove_prefix(1);
    double value        = 0.;
    const auto [end, e] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (e != std::errc() || end != word.data() + word.size())
      refuse(fmt::format("\"{}\" is not a number{}; correct it, or export the surface again", shown(word),
                         word.find(',') != std::string_view::npos ? " (decimals take a point)" : ""));
    if (!std::isfinite(value))
      refuse(fmt::format("a coordinate is \"{}\"; correct it, or export the surface again", shown(word)));
    return value;
  }

  long long SurfaceWords::integer()
  {
    const std::string_view word  = needed();
    long long              value = 0;
    const auto [end, e]          = std::from_chars(word.data(), word.data() + word.size(), value);
    if (e != std::errc() || end != word.data() + word.size())
      refuse(fmt::format("\"{}\" is not a whole number; export the surface again", shown(word)));
    return value;
  }

  std::string SurfaceWords::quoted()
  {
    std::string_view first = needed();
    if (!first.starts_with('"'))
      refuse(fmt::format("\"{}\" stands where a name in quotes belongs; export the surface again", shown(first)));
    const std::size_t begin = at_ - first.size() + 1, end = text_.find_first_of("\"\n", begin);
    if (end == std::string_view::npos || text_[end] == '\n')
      refuse("a name in quotes has no end; export the surface again");
    at_ = end + 1;
    return text_line(std::string(text_.substr(begin, end - begin)));
  }

  void SurfaceWords::skip_line()
  {
    at_ = std::min(text_.find('\n', at_), text_.size());
  }

  void SurfaceWords::refuse(const std::string &cause) const
  {
    refuse_file(file_, "the surface", fmt::format("line {}: {}", line_, text_line(cause)));
  }
} // namespace swimtwin
