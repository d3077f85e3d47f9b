// The pictures of a run.
#pragma once

#include <datasets/run/plane_flow.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/scene.h>
#include <reports/page/gnuplot.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Draw the pictures that make sense for the run into folder/pictures: trajectory, angles, stroke_loop,
  /// power_balance, shapes, spatial_view, flow_in_plane (.png), with the data (.dat) and gnuplot scripts (.gp) beside
  /// them; earlier ones of these names are removed. Returns the PNG files drawn. A run does not depend on its pictures:
  /// what goes wrong is told in `warning`, one sentence with its remedy, empty when all is well. Fewer than three
  /// instants: nothing to draw.
  std::vector<std::filesystem::path> draw_run(const std::filesystem::path &folder, const Scene &scene,
                                              const Trajectory &trajectory, const RunSummary &summary,
                                              const std::optional<SnapshotSet> &snapshots,
                                              const std::vector<PlaneFlow> &flows, std::string &warning);
} // namespace swimtwin
