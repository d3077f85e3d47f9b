// The page of a plan.
#pragma once

#include <reports/plan/plan_files.h>
#include <reports/run/run_report.h>

namespace swimtwin
{
  /// Verdict, fields, pictures, searches, replay, trade-off, goal, provenance.
  HtmlPage plan_page(const PlanFolder &folder, const Illustrations &illustrations);
} // namespace swimtwin
