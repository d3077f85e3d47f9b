#include <reports/run/shapes_picture.h>

#include <reports/page/picture_extent.h>
#include <reports/page/shown_units.h>
#include <reports/run/run_scripts.h>
#include <reports/run/shown_instants.h>
#include <reports/run/swimmer_shapes.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    constexpr int n_instants = 8;

    /// The swimmer at one instant; `time` is the phase in periods, or s without a period.
    struct Shape
    {
      double               time = 0.;
      std::vector<Outline> tail;
      Outline              head;
    };

    std::vector<Shape> shapes_with_tail(const ShownRun &run)
    {
      const SnapshotSet &set     = *run.snapshots;
      const auto         time_of = [&](const std::size_t i) { return set.time_s[i]; };
      std::vector<Shape> shapes;
      for (const std::size_t i : closest_instants(run, n_instants, set.time_s.size(), time_of))
      {
        const auto row = static_cast<Eigen::Index>(i);
        shapes.push_back({shown_time(run, set.time_s[i]), tail_outlines(set, i),
                          head_outline(run.scene.head, {set.pose(row, 0), set.pose(row, 1), set.pose(row, 2)})});
      }
      return shapes;
    }

    std::vector<Shape> shapes_of_head(const ShownRun &run)
    {
      const auto         time_of = [&](const std::size_t i) { return run.trajectory[i].time_s; };
      std::vector<Shape> shapes;
      for (const std::size_t i : closest_instants(run, n_instants, run.trajectory.size(), time_of))
      {
        const TrajectoryRow &row = run.trajectory[i];
        shapes.push_back({shown_time(run, row.time_s),
                          {},
                          head_outline(run.scene.head, {row.head_x_m, row.head_y_m, row.head_angle_rad})});
      }
      return shapes;
    }

    void add_path(const ShownRun &run, GnuplotTable &table, PictureExtent &extent)
    {
      table.begin_block(run.axis.label + ", x (mm), y (mm)");
      for (const TrajectoryRow &row : run.last_period())
      {
        const double x = mm * (run.has_tail() ? row.tail_tip_x_m : row.head_x_m);
        const double y = mm * (run.has_tail() ? row.tail_tip_y_m : row.head_y_m);
        table.add_row({run.time(row.time_s), x, y});
        extent.add({x, y});
      }
    }

    void add_outline(const double time, const Outline &outline, GnuplotTable &table, PictureExtent &extent)
    {
      for (std::size_t i = 0; i <= outline.size(); ++i)
      {
        const auto [x_m, y_m] = outline[i % outline.size()];
        table.add_row({time, mm * x_m, mm * y_m});
        extent.add({mm * x_m, mm * y_m});
      }
    }

    void add_shape(const Shape &shape, GnuplotTable &table, PictureExtent &extent)
    {
      table.begin_block("tail: time or phase, x (mm), y (mm)");
      for (const Outline &outline : shape.tail)
        add_outline(shape.time, outline, table, extent);
      table.begin_block("head: time or phase, x (mm), y (mm)");
      add_outline(shape.time, shape.head, table, extent);
    }
  } // namespace

  GnuplotPicture shapes_picture(const ShownRun &run)
  {
    const bool     periodic = run.has_full_period();
    GnuplotPicture picture  = make_picture(run, "shapes", gnuplot_scripts::shapes, "Shapes of the swimmer",
                                          periodic ? "the last full period" : "the whole run");
    PictureExtent  extent;
    std::string    instants;
    add_path(run, picture.table, extent);
    for (const Shape &shape : run.has_tail() ? shapes_with_tail(run) : shapes_of_head(run))
    {
      add_shape(shape, picture.table, extent);
      instants += fmt::format("{}{:.6g}", instants.empty() ? "" : " ", shape.time);
    }
    extent.set_in(picture);
    picture.set_text("instants", instants);
    picture.set_flag("cyclic", periodic);
    picture.set("t_min", periodic ? 0. : shown_time(run, run.trajectory.front().time_s));
    picture.set("t_max", periodic ? 1. : shown_time(run, run.trajectory.back().time_s));
    picture.set_text("instant_label", periodic ? "time in the period (periods)" : run.axis.label);
    picture.set_text("path_title", run.has_tail() ? "path of the tail's tip" : "path of the head's centre");
    return picture;
  }
} // namespace swimtwin
