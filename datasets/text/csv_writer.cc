#include <datasets/text/csv_writer.h>

#include <datasets/files/output_folder.h>
#include <datasets/text/text_line.h>

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <set>

namespace swimtwin
{
  namespace
  {
    /// A line that starts with # would be a comment, blanks at the ends are trimmed by many readers.
    bool needs_quotes(const std::string &text)
    {
      return text.find_first_of(",\"") != std::string::npos || text.starts_with('#') || text.starts_with(' ') ||
             text.ends_with(' ');
    }

    std::string quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        result += c == '"' ? "\"\"" : std::string(1, c);
      return result + "\"";
    }
  } // namespace

  CsvWriter::CsvWriter(const std::vector<std::string> &column_names) : n_columns_(column_names.size())
  {
    assert(std::set<std::string>(column_names.begin(), column_names.end()).size() == n_columns_);
    for (const std::string &name : column_names)
      cell(name);
    end_row();
    n_rows_ = 0; // the header is none
  }

  CsvWriter &CsvWriter::cell(const double value)
  {
    return word(std::isfinite(value) ? fmt::format("{}", value) : "");
  }

  CsvWriter &CsvWriter::cell(const std::string &text)
  {
    const std::string line = text_line(text);
    return word(needs_quotes(line) ? quoted(line) : line);
  }

  void CsvWriter::end_row()
  {
    assert(n_cells_ == n_columns_);
    text_ += '\n';
    n_cells_ = 0;
    ++n_rows_;
  }

  void CsvWriter::save(const std::filesystem::path &file) const
  {
    write_text_atomically(file, text_);
  }

  CsvWriter &CsvWriter::word(const std::string &characters)
  {
    text_ += (n_cells_++ == 0 ? "" : ",") + characters;
    return *this;
  }
} // namespace swimtwin
