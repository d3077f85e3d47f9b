// Whether a page is well formed, and what stands in its tables.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// The first place where the tags of a page do not match; empty if every element that is opened is closed in turn.
  inline std::string first_unbalanced_tag(const std::string &html)
  {
    std::vector<std::string> open;
    for (std::size_t begin = html.find('<'); begin != std::string::npos; begin = html.find('<', begin + 1))
    {
      const std::size_t end = html.find_first_of("<>", begin + 1);
      if (end == std::string::npos || html[end] == '<')
        return html.substr(begin, 40);
      const std::string tag = html.substr(begin + 1, end - begin - 1);
      if (tag.starts_with('!') || tag.ends_with('/'))
        continue;
      const std::string name = tag.substr(0, tag.find(' '));
      if (!name.starts_with('/'))
        open.push_back(name);
      else if (open.empty() || open.back() != name.substr(1))
        return html.substr(begin, 40);
      else
        open.pop_back();
    }
    return open.empty() ? "" : fmt::format("<{}> is not closed", open.back());
  }

  /// The cells after the first in the first table row that `name` begins; tags within them are left.
  inline std::vector<std::string> cells_of(const std::string &html, const std::string &name)
  {
    const std::string head = fmt::format("<tr><th scope=\"row\">{}</th>", name);
    std::size_t       at   = html.find(head);
    if (at == std::string::npos)
      return {};
    const std::size_t        end = html.find("</tr>", at);
    std::vector<std::string> cells;
    for (at = html.find("<td>", at); at < end; at = html.find("<td>", at + 1))
      cells.push_back(html.substr(at + 4, html.find("</td>", at) - at - 4));
    return cells;
  }

  /// The number in a cell that was written for people.
  inline double number_in(const std::string &cell)
  {
    const std::string minus = "−";
    const std::size_t at    = cell.find(minus);
    return std::stod(
        at == std::string::npos ? cell : fmt::format("{}-{}", cell.substr(0, at), cell.substr(at + minus.size())));
  }
} // namespace swimtwin
