#include <datasets/system/nearest_name.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    std::size_t edit_distance(const std::string_view a, const std::string_view b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0u);
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        std::size_t diagonal = row[0];
        row[0]               = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j)
        {
          const std::size_t above = row[j + 1];
          row[j + 1]              = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0u : 1u)});
          diagonal                = above;
        }
      }
      return row.back();
    }

    std::string in_lower_case(std::string text)
    {
      for (char &letter : text)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      return text;
    }

    std::string_view without_ending(const std::string_view name)
    {
      const auto dot = name.rfind('.');
      return dot == 0 ? name : name.substr(0, dot);
    }

    bool is_close(const std::string_view a, const std::string_view b)
    {
      const std::size_t distance = edit_distance(a, b);
      return 4 * distance <= std::max(a.size(), b.size()) || without_ending(a) == without_ending(b);
    }
  } // namespace

  std::string nearest_name(const std::string_view word, const std::vector<std::string> &candidates)
  {
    const auto closer = [&](const std::string &a, const std::string &b) {
      return edit_distance(word, a) < edit_distance(word, b);
    };
    const auto best = std::min_element(candidates.begin(), candidates.end(), closer);
    return best == candidates.end() ? std::string() : *best;
  }

  std::optional<std::string> close_name(const std::string &word, const std::vector<std::string> &candidates)
  {
    std::vector<std::string> lower;
    for (const std::string &candidate : candidates)
      lower.push_back(in_lower_case(candidate));
    const std::string wanted = in_lower_case(word), nearest = nearest_name(wanted, lower);
    if (nearest.empty() || !is_close(wanted, nearest))
      return std::nullopt;
    return candidates[static_cast<std::size_t>(std::find(lower.begin(), lower.end(), nearest) - lower.begin())];
  }
} // namespace swimtwin
