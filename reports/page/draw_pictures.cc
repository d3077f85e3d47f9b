#include <reports/page/draw_pictures.h>

#include <datasets/system/console.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Goes on after a picture that fails, while there is time; `warning` then tells the last failure.
    std::vector<fs::path> draw_each(const fs::path &folder, const std::vector<GnuplotPicture> &pictures,
                                    std::string &warning)
    {
      using Clock               = std::chrono::steady_clock;
      const auto            end = Clock::now() + drawing_limit;
      std::vector<fs::path> drawn;
      for (auto picture = pictures.begin(); picture != pictures.end() && Clock::now() < end; ++picture)
        try
        {
          const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
          drawn.push_back(draw_png(folder, picture->name, left));
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
      const auto fault = find_gnuplot_fault();
      if (!fault)
        return draw_each(folder, pictures, warning);
      warning = fmt::format("no pictures were drawn because {}; {} and run it on the .gp files in {}.", fault->cause,
                            fault->remedy, folder.string());
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

  std::vector<fs::path> draw_beside_results(const fs::path &output, const std::vector<GnuplotPicture> &pictures,
                                            const std::string &origin)
  {
    std::string                 warning;
    const std::vector<fs::path> drawn = draw_pictures(output / pictures_folder_name, pictures, origin, warning);
    if (!warning.empty())
      remark(warning);
    return drawn;
  }
} // namespace swimtwin
