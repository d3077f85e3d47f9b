#include <reports/page/refinement_table.h>

#include <reports/page/number_text.h>

namespace swimtwin
{
  void add_refinement(HtmlPage &page, const std::vector<RefinementRound> &rounds)
  {
    if (rounds.empty())
      return;
    constexpr int digits = 2;
    HtmlTable     table{{"model", "off the full-order model at its own result (%)"}, {}};
    for (const RefinementRound &round : rounds)
      table.rows.push_back({{round.model_file}, {plain_number(100. * round.difference, digits)}});
    page.add_heading("Refinement of the model");
    page.add_table(table);
  }
} // namespace swimtwin
