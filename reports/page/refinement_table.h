// Rounds of a refinement, for the pages of plans and fits.
#pragma once

#include <datasets/run/refinement.h>
#include <reports/page/html_page.h>

#include <vector>

namespace swimtwin
{
  /// With a heading; nothing if there are none.
  void add_refinement(HtmlPage &page, const std::vector<RefinementRound> &rounds);
} // namespace swimtwin
