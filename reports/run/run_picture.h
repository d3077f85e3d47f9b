// What the pictures of a run have in common: the run they show, a heading, a time axis.
#pragma once

#include <datasets/run/plane_flow.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/scene.h>
#include <reports/page/gnuplot.h>
#include <reports/run/motion_curves.h>

#include <optional>
#include <string>
#include <string_view>

namespace swimtwin
{
  /// A run as it is shown; the trajectory is not empty.
  struct ShownRun
  {
    const Scene                      &scene;
    const Trajectory                 &trajectory;
    const RunSummary                 &summary;
    const std::optional<SnapshotSet> &snapshots;
    const std::vector<PlaneFlow>     &flows;
    TimeAxis                          axis;

    double time(double time_s) const { return axis(time_s); }
    bool   head_moves() const { return scene.head.motion != HeadMotion::fixed; }
    bool   has_tail() const { return scene.tail.has_value(); }
    /// The last full period; all rows without one.
    Rows last_period() const { return last_periods(trajectory, axis, 1); }
    bool has_full_period() const { return n_full_periods(trajectory, axis) > 0; }
  };

  /// `finding` goes under the heading, after the scene's name.
  GnuplotPicture make_picture(const ShownRun &run, const std::string &name, std::string_view script,
                              const std::string &heading, const std::string &finding);

  /// Label and limits of a time axis over these rows.
  void set_time_axis(GnuplotPicture &picture, const ShownRun &run, Rows rows);
} // namespace swimtwin
