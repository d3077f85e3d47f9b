// The page of a sweep.
#pragma once

#include <reports/run/run_report.h>
#include <reports/sweep/sweep_folder.h>

#include <filesystem>

namespace swimtwin
{
  /// Verdict, curves with their peaks, runs, table. Runs that have a page are linked, as seen from `page_folder`.
  HtmlPage sweep_page(const SweepFolder &sweep, const Illustrations &illustrations,
                      const std::filesystem::path &page_folder);
} // namespace swimtwin
