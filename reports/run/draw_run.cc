#include <reports/run/draw_run.h>

#include <datasets/scene/mirror_plane.h>
#include <datasets/system/error.h>
#include <reports/page/draw_pictures.h>
#include <reports/run/flow_picture.h>
#include <reports/run/motion_pictures.h>
#include <reports/run/shapes_picture.h>
#include <reports/run/spatial_view.h>

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
      const bool has_shapes = run.snapshots && !run.snapshots->time_s.empty(),
                 is_planar  = way_out_of_plane(run.scene).empty();
      std::vector<GnuplotPicture> pictures;
      if (run.head_moves())
        pictures.push_back(trajectory_picture(run));
      if (run.head_moves() || run.has_tail())
        pictures.push_back(angles_picture(run));
      if (is_planar && run.head_moves() && run.has_tail() && run.has_full_period() &&
          stroke_loop_area_rad2(run.last_period()) != 0.)
        pictures.push_back(stroke_loop_picture(run));
      if (has_power(run.trajectory))
        pictures.push_back(power_balance_picture(run));
      if (run.has_tail() ? has_shapes : run.head_moves())
      {
        if (is_planar && !run.scene.head.surface) // which has no outline in the plane
          pictures.push_back(shapes_picture(run));
        if (run.scene.dimension == 3)
          pictures.push_back(spatial_view_picture(run));
      }
      if (has_flow(run))
        pictures.push_back(flow_picture(run));
      return pictures;
    }

    void remove_earlier_pictures(const fs::path &folder)
    {
      std::error_code ignored; // what cannot be removed cannot be replaced either, and that is told
      for (const std::string name :
           {"trajectory", "angles", "stroke_loop", "power_balance", "shapes", "spatial_view", "flow_in_plane"})
        for (const std::string ending : {".png", ".gp", ".dat"})
          fs::remove(folder / (name + ending), ignored);
    }
  } // namespace

  std::vector<fs::path> draw_run(const fs::path &folder, const Scene &scene, const Trajectory &trajectory,
                                 const RunSummary &summary, const std::optional<SnapshotSet> &snapshots,
                                 const std::vector<PlaneFlow> &flows, std::string &warning)
  {
    warning.clear();
    if (trajectory.size() < n_rows_min)
      return {};
    const fs::path pictures_folder = folder / pictures_folder_name;
    const ShownRun run{scene, trajectory, summary, snapshots, flows, time_axis(scene, trajectory)};
    remove_earlier_pictures(pictures_folder);
    return draw_pictures(pictures_folder, choose_pictures(run),
                         fmt::format("scene {}, hash {}", scene.name, scene.hash), warning);
  }
} // namespace swimtwin
