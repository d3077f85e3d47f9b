// The page of a plan.
#pragma once

#include <app/plan_files.h>
#include <app/run_report.h>

namespace swimtwin
{
  /// Verdict, fields, pictures, searches, replay, trade-off, goal, provenance.
  HtmlPage plan_page(const PlanFolder &folder, const Illustrations &illustrations);
} // namespace swimtwin
