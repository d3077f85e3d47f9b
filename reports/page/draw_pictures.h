// Pictures that a computation can do without.
#pragma once

#include <reports/page/gnuplot.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Draw into a folder, made if it is not there, with data (.dat) and gnuplot scripts (.gp) beside the PNG files;
  /// `origin` is a comment in each. Returns the PNG files drawn. What goes wrong is told in `warning`, one sentence
  /// with its remedy, empty when all is well.
  std::vector<std::filesystem::path> draw_pictures(const std::filesystem::path       &folder,
                                                   const std::vector<GnuplotPicture> &pictures,
                                                   const std::string &origin, std::string &warning);

  /// Where the pictures of results are, in their folder.
  inline constexpr const char *pictures_folder_name = "pictures";

  /// Draw there, and say on stderr what went wrong. Returns the PNG files drawn.
  std::vector<std::filesystem::path> draw_beside_results(const std::filesystem::path       &output,
                                                         const std::vector<GnuplotPicture> &pictures,
                                                         const std::string                 &origin);
} // namespace swimtwin
