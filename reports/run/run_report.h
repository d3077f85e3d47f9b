// The page of one run.
#pragma once

#include <reports/page/illustrated_page.h>
#include <reports/run/run_folder.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Verdict, displacement, pictures, power balance, effort, numerics, provenance, scene.
  HtmlPage run_page(const RunFolder &run, const Illustrations &illustrations);
} // namespace swimtwin
