#include <app/motion_pictures.h>
#include <app/plots.h>
#include <app/shapes_picture.h>
#include <datasets/error.h>

#include <fmt/format.h>

#include <system_error>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr std::size_t n_rows_min = 3;

    std::vector<GnuplotPicture> choose_pictures(const ShownRun &run)
    {
      const bool                  has_shapes = run.snapshots && !run.snapshots->time_s.empty();
      std::vector<GnuplotPicture> pictures;
      if (run.head_moves())
        pictures.push_back(trajectory_picture(run));
      if (run.head_moves() || run.has_tail())
        pictures.push_back(angles_picture(run));
      if (run.head_moves() && run.has_tail() && run.has_full_period() && stroke_loop_area_rad2(run.last_period()) != 0.)
        pictures.push_back(stroke_loop_picture(run));
      if (has_power(run.trajectory))
        pictures.push_back(power_balance_picture(run));
      if (run.has_tail() ? has_shapes : run.head_moves())
        pictures.push_back(shapes_picture(run));
      return pictures;
    }

    void remove_earlier_pictures(const fs::path &folder)
    {
      std::error_code ignored; // what cannot be removed cannot be replaced either, and that is told
      for (const std::string name : {"trajectory", "angles", "stroke_loop", "power_balance", "shapes"})
        for (const std::string ending : {".png", ".gp", ".dat"})
          fs::remove(folder / (name + ending), ignored);
    }

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

  std::vector<fs::path> draw_run(const fs::path &folder, const Scene &scene, const Trajectory &trajectory,
                                 const RunSummary &summary, const std::optional<SnapshotSet> &snapshots,
                                 std::string &warning)
  {
    warning.clear();
    if (trajectory.size() < n_rows_min)
      return {};
    const fs::path pictures_folder = folder / "pictures";
    const ShownRun run{scene, trajectory, summary, snapshots, time_axis(scene, trajectory)};
    remove_earlier_pictures(pictures_folder);
    return draw_pictures(pictures_folder, choose_pictures(run),
                         fmt::format("scene {}, hash {}", scene.name, scene.hash), warning);
  }
} // namespace swimtwin
