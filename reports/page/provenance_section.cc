#include <reports/page/provenance_section.h>

namespace swimtwin
{
  void add_provenance(HtmlPage &page, const Provenance &provenance,
                      const std::vector<std::pair<std::string, std::string>> &more)
  {
    HtmlTable table{{},
                    {{{"program"}, {provenance.program_version}},
                     {{"command"}, {provenance.command_line}},
                     {{"scene hash"}, {provenance.scene_hash}},
                     {{"created"}, {provenance.created}}},
                    true};
    for (const auto &[name, text] : more)
      table.rows.push_back({{name}, {text}});
    page.add_heading("Provenance");
    page.add_table(table);
  }
} // namespace swimtwin
