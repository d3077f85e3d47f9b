#include <reports/page/draw_pictures.h>

#include <datasets/error.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Goes on after a picture that fails; `warning` then tells the last failure.
    std::vector<fs::path> draw_each(const fs::path &folder, const std::vector<GnuplotPicture> &pictures,
                                    std::string &warning)
    {
      std::vector<fs::path> drawn;
      for (const GnuplotPicture &picture : pictures)
        try
        {
          drawn.push_back(draw_png(folder, picture.name));
        }
        catch (const ComputationError &error)
        {
          warning = fmt::format("{}; if gnuplot lacks its PNG terminal, install it with `apt-get install gnuplot-nox`.",
                                error.what());
        }
      return drawn;
    }
  } // namespace

  std::vector<fs::path> draw_pictures(const fs::path &folder, const std::vector<GnuplotPicture> &pictures,
                                      const std::string &origin, std::string &warning)
  {
    warning.clear();
    try
    {
      fs::create_directories(folder);
      for (const GnuplotPicture &picture : pictures)
        write_gnuplot_files(folder, picture, origin);
      if (gnuplot_is_installed())
        return draw_each(folder, pictures, warning);
      warning = fmt::format("no pictures were drawn because gnuplot is not installed; install it with `apt-get install "
                            "gnuplot-nox` and run it on the .gp files in {}.",
                            folder.string());
    }
    catch (const ComputationError &error)
    {
      warning = fmt::format("no pictures were drawn: {}.", error.what());
    }
    catch (const fs::filesystem_error &error)
    {
      warning = fmt::format("no pictures were drawn: cannot create {}: {}.", folder.string(), error.code().message());
    }
    return {};
  }
} // namespace swimtwin
