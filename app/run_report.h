// The page of one run.
#pragma once

#include <app/html_page.h>
#include <app/run_folder.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What goes with the tables of a page.
  struct Illustrations
  {
    std::vector<std::filesystem::path> pictures; ///< PNG files
    std::string                        warning;  ///< why some are missing; empty when all is well
  };

  /// Verdict, displacement, pictures, power balance, effort, numerics, provenance, scene.
  HtmlPage run_page(const RunFolder &run, const Illustrations &illustrations);

  /// The pictures under a heading; the warning above them.
  void add_illustrations(HtmlPage &page, const Illustrations &illustrations);
} // namespace swimtwin
