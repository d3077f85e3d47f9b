// Where results came from, at the end of their page.
#pragma once

#include <datasets/system/provenance.h>
#include <reports/page/html_page.h>

#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  /// Program, command, scene hash and time under a heading, and further lines of the table.
  void add_provenance(HtmlPage &page, const Provenance &provenance,
                      const std::vector<std::pair<std::string, std::string>> &more = {});
} // namespace swimtwin
