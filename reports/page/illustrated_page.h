// A page in the folder of its results, with its pictures.
#pragma once

#include <reports/page/gnuplot.h>
#include <reports/page/html_page.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// The file that a page is, in the folder of --output.
  inline constexpr const char *page_name = "report.html";

  /// What goes with the tables of a page.
  struct Illustrations
  {
    std::vector<std::filesystem::path> pictures; ///< PNG files
    std::string                        warning;  ///< why some are missing; empty when all is well
  };

  /// Draw into output/pictures (see draw_pictures).
  Illustrations illustrate(const std::filesystem::path &output, const std::vector<GnuplotPicture> &pictures,
                           const std::string &origin);

  /// The pictures under a heading; the warning above them.
  void add_illustrations(HtmlPage &page, const Illustrations &illustrations);

  /// Write report.html, and say on stderr what its pictures lack.
  void write_illustrated_page(const std::filesystem::path &output, const HtmlPage &page,
                              const Illustrations &illustrations);
} // namespace swimtwin
