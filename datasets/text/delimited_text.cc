#include <datasets/system/error.h>
#include <datasets/text/delimited_text.h>

#include <boost/algorithm/string/predicate.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace swimtwin
{
  namespace
  {
    constexpr std::string_view                separators = "\t;,|";
    constexpr std::array<std::string_view, 2> wide_blanks{"\u00A0", "\u202F"}; // not broken: of typesetting and Excel

    std::string_view trimmed(std::string_view text)
    {
      const auto ends   = [&](const std::string_view blank) { return text.ends_with(blank); };
      const auto begins = [&](const std::string_view blank) { return text.starts_with(blank); };
      for (bool again = true; again;)
      {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\n"), text.size()));
        text  = text.substr(0, text.find_last_not_of(" \t\n") + 1);
        again = false;
        for (const std::string_view blank : wide_blanks)
        {
          if (begins(blank))
            text.remove_prefix(blank.size()), again = true;
          if (ends(blank))
            text.remove_suffix(blank.size()), again = true;
        }
      }
      return text;
    }

    /// Whether quotes are open behind a text that is read from outside them: they open where a cell begins.
    class QuoteState
    {
    public:
      bool is_open() const { return open_; }

      void pass(const char c, const std::string_view cell_starts)
      {
        if (c == '"' && (open_ || at_start_))
          open_ = !open_;
        // A doubled quote closes and opens again.
        at_start_ = cell_starts.find(c) != std::string_view::npos || (at_start_ && c == ' ') || (c == '"' && !open_);
      }

    private:
      bool open_ = false, at_start_ = true;
    };

    bool is_comment(const std::string_view row)
    {
      return row.starts_with('#');
    }

    std::size_t end_of_row(const std::string_view text, const std::size_t begin)
    {
      const std::size_t end_of_line = std::min(text.find('\n', begin), text.size());
      if (is_comment(trimmed(text.substr(begin, end_of_line - begin))))
        return end_of_line;
      QuoteState quotes;
      for (std::size_t i = begin; i < text.size(); ++i)
        if (text[i] == '\n' && !quotes.is_open())
          return i;
        else
          quotes.pass(text[i], "\t;,|");
      return quotes.is_open() ? end_of_line : text.size(); // a quote that nothing closes is a sign like any other
    }

    bool is_blank(const std::string_view row)
    {
      return row.find_first_not_of("\t;,|\" ") == std::string_view::npos;
    }

    std::vector<TextRow> rows_of(const std::string_view text)
    {
      std::vector<TextRow> rows;
      std::size_t          line = 1;
      for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t      end = end_of_row(text, begin);
        const std::string_view row = text.substr(begin, end - begin);
        rows.push_back({line, std::string(row)});
        line += 1u + static_cast<std::size_t>(std::count(row.begin(), row.end(), '\n'));
        begin = end + 1;
      }
      return rows;
    }

    /// What a spreadsheet writes where it has no number (`#N/A N/A`, `#DIV/0!`), or no room for one (`####`).
    bool is_error_of_a_spreadsheet(const std::string_view cell)
    {
      constexpr std::array<std::string_view, 6> words{"#NV", "#N/D", "#N/B", "#I/T", "#SAKNAS", "#\u041D/\u0414"};
      return cell.starts_with("#N/A") || std::find(words.begin(), words.end(), cell) != words.end() ||
             ((cell.ends_with('!') || cell.ends_with('?')) && cell.find(' ') == std::string_view::npos) ||
             (cell.size() > 1 && cell.find_first_not_of('#') == std::string_view::npos);
    }

    /// A row whose first cell is such an error, which is no comment.
    bool begins_with_an_error(const std::string_view row)
    {
      const auto end = row.find_first_of(separators);
      return end != std::string_view::npos && is_error_of_a_spreadsheet(trimmed(row.substr(0, end))) &&
             !is_blank(row.substr(end));
    }

    /// `sep=;` of the first line, which Excel writes and reads; it is taken out.
    char stated_separator(std::vector<TextRow> &rows, const std::string &file)
    {
      if (rows.empty())
        return '\0';
      std::string_view first = rows.front().text;
      while (!first.empty() && first.front() == '"')
        first.remove_prefix(1);
      if (!boost::algorithm::istarts_with(first, "sep="))
        return '\0';
      const char separator = first.size() > 4 ? first[4] : '\0';
      if (separators.find(separator) == std::string_view::npos)
        throw InputError(fmt::format("{}:{}: \"{}\" names no separator that is known; write sep=; or sep=, or a tab.",
                                     file, rows.front().line, first));
      rows.erase(rows.begin());
      return separator;
    }

    std::vector<char> separators_in(const std::string_view row)
    {
      std::vector<char> found;
      for (const char separator : separators)
        if (split_cells(row, separator).size() > 1)
          found.push_back(separator);
      return found;
    }

    bool makes_equal_rows(const std::vector<TextRow> &rows, const char separator)
    {
      const std::size_t n = split_cells(rows.front().text, separator).size();
      return std::all_of(rows.begin(), rows.end(),
                         [&](const TextRow &row) { return split_cells(row.text, separator).size() == n; });
    }

    /// Words in the header, and as many in each row, or one more where rows are numbered.
    bool makes_rows_of_words(const std::vector<TextRow> &rows)
    {
      const auto        n_words = [](const TextRow &row) { return split_cells(row.text, ' ').size(); };
      const std::size_t n = n_words(rows.front()), n_below = rows.size() > 1 ? n_words(rows[1]) : n;
      return n > 1 && (n_below == n || n_below == n + 1) &&
             std::all_of(rows.begin() + 1, rows.end(), [&](const TextRow &row) { return n_words(row) == n_below; });
    }

    std::string name_of(const char separator)
    {
      return separator == '\t' ? "tabs" : fmt::format("\"{}\"", separator);
    }

    char find_separator(const std::vector<TextRow> &rows, const std::string &file)
    {
      if (rows.empty())
        return ',';
      std::vector<char> found = separators_in(rows.front().text);
      if (found.empty() && rows.size() > 1) // a title, or a single column, or blanks
        found = separators_in(rows[1].text);
      if (found.empty() || (separators_in(rows.front().text).empty() && found == std::vector<char>{','}))
        return makes_rows_of_words(rows) ? ' ' : ',';
      if (found.size() == 1)
        return found.front();
      std::vector<char> equal;
      std::copy_if(found.begin(), found.end(), std::back_inserter(equal),
                   [&](const char separator) { return makes_equal_rows(rows, separator); });
      if (equal.size() > 1)
        throw InputError(fmt::format("{}:{}: the columns may be separated by {} or by {}; say which with a first line "
                                     "sep={}.",
                                     file, rows.front().line, name_of(equal[0]), name_of(equal[1]), equal[1]));
      if (equal.size() == 1)
        return equal.front();
      return *std::max_element(found.begin(), found.end(), [&](const char a, const char b) {
        return split_cells(rows.front().text, a).size() < split_cells(rows.front().text, b).size();
      });
    }

    std::string cell_of(std::string_view text)
    {
      text = trimmed(text);
      if (text.size() < 2 || text.front() != '"' || text.back() != '"')
        return std::string(text);
      std::string cell;
      text = trimmed(text.substr(1, text.size() - 2));
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        cell += text[i] == '\n' ? ' ' : text[i];
        if (text.substr(i, 2) == "\"\"")
          ++i;
      }
      return cell;
    }

    std::vector<std::string> split_at_blanks(std::string_view row)
    {
      std::vector<std::string> cells;
      for (row = trimmed(row); !row.empty(); row = trimmed(row))
      {
        const std::size_t begin = row.front() == '"' ? std::min(row.find('"', 1), row.size()) : 0;
        const std::size_t end   = std::min(row.find_first_of(" \t", begin), row.size());
        cells.push_back(cell_of(row.substr(0, end)));
        row.remove_prefix(end);
      }
      return cells;
    }
  } // namespace

  std::vector<std::string> split_cells(const std::string_view row, const char separator)
  {
    if (separator == ' ')
      return split_at_blanks(row);
    std::vector<std::string> cells;
    QuoteState               quotes;
    std::size_t              begin = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      if (row[i] == separator && !quotes.is_open())
      {
        cells.push_back(cell_of(row.substr(begin, i - begin)));
        begin = i + 1;
      }
      quotes.pass(row[i], std::string_view(&separator, 1));
    }
    cells.push_back(cell_of(row.substr(begin)));
    return cells;
  }

  DelimitedText split_rows(const std::string_view text, const std::string &file)
  {
    DelimitedText result;
    result.rows                    = rows_of(text);
    const char stated              = stated_separator(result.rows, file);
    bool       is_below_the_header = false;
    std::erase_if(result.rows, [&](const TextRow &row) {
      const std::string_view content = trimmed(row.text);
      const bool             is_row =
          !is_blank(content) && (!is_comment(content) || (is_below_the_header && begins_with_an_error(content)));
      is_below_the_header = is_below_the_header || is_row;
      return !is_row;
    });
    result.separator = stated != '\0' ? stated : find_separator(result.rows, file);
    return result;
  }
} // namespace swimtwin
