// The tables of a run's page.
#pragma once

#include <reports/page/html_page.h>
#include <reports/run/run_folder.h>

#include <string>

namespace swimtwin
{
  /// Displacement of every full period.
  HtmlTable displacement_table(const RunFolder &run);

  /// Whether the trajectory tells the works.
  bool has_works(const RunFolder &run);
  /// Works of the last full period.
  HtmlTable work_table(const RunFolder &run);
  HtmlTable imbalance_table(const RunSummary &summary);

  /// Counts, times and memory.
  HtmlTable effort_table(const RunSummary &summary);
  /// CPU time of the parts of the program, with what none of them accounts for.
  HtmlTable cpu_table(const RunSummary &summary);

  /// What the program chose or was told.
  HtmlTable numerics_table(const Scene &scene);

  /// A displacement (m) of a run whose scene is known.
  std::string in_body_lengths(const RunFolder &run, double displacement_m);
} // namespace swimtwin
