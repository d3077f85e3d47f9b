#include <reports/run/motion_pictures.h>

#include <reports/page/number_text.h>
#include <reports/page/picture_extent.h>
#include <reports/page/shown_units.h>
#include <reports/run/absent_figures.h>
#include <reports/run/run_scripts.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int n_periods_of_angles = 12, n_periods_of_power = 2;

    bool any_nonzero(const Rows rows, double TrajectoryRow::*const member)
    {
      return std::any_of(rows.begin(), rows.end(), [&](const TrajectoryRow &row) { return row.*member != 0.; });
    }

    std::string displacement_finding(const ShownRun &run)
    {
      if (run.axis.periodic && run.summary.net_displacement_m)
        return fmt::format("{} mm ({} body lengths) in the last full period, positive head first",
                           signed_number(mm * *run.summary.net_displacement_m, 4),
                           signed_number(*run.summary.net_displacement_m / run.scene.body_length_m(), 2));
      return fmt::format("{} mm in {:.4g} s, positive head first",
                         signed_number(mm * displacement_m(run.trajectory, run.trajectory.back()), 4),
                         run.trajectory.back().time_s - run.trajectory.front().time_s);
    }

    /// Rows at the multiples of the period; the first and the last row when there is no period.
    std::vector<TrajectoryRow> period_borders(const ShownRun &run)
    {
      constexpr double round_off = 1e-6;
      if (!run.axis.periodic)
        return {run.trajectory.front(), run.trajectory.back()};
      std::vector<TrajectoryRow> borders;
      for (const TrajectoryRow &row : run.trajectory)
        if (const double periods = run.time(row.time_s); std::abs(periods - std::round(periods)) < round_off)
          borders.push_back(row);
      return borders;
    }

    std::string angles_heading(const ShownRun &run)
    {
      if (run.head_moves() && run.has_tail())
        return "Angles of head and tail";
      return run.has_tail() ? "Angle of the tail" : "Angle of the head";
    }

    std::string loop_finding(const Rows rows)
    {
      const double area = degrees * degrees * stroke_loop_area_rad2(rows);
      return fmt::format("the last full period encloses {:.4g} degrees², {}", std::abs(area),
                         area > 0. ? "counter-clockwise" : "clockwise");
    }

    std::array<double, 2> loop_point(const TrajectoryRow &row)
    {
      return {degrees * row.head_angle_rad, degrees * row.tail_angle_rad};
    }

    std::size_t row_at_phase(const Rows rows, const double phase)
    {
      const double time_s = rows.front().time_s + phase * (rows.back().time_s - rows.front().time_s);
      const auto   row    = std::lower_bound(rows.begin(), rows.end(), time_s - 1e-9 * std::abs(time_s),
                                             [](const TrajectoryRow &a, const double t) { return a.time_s < t; });
      return std::min(static_cast<std::size_t>(row - rows.begin()), rows.size() - 1);
    }

    /// Marks at the quarters of the period with their labels outside the loop, and arrows half way between them.
    void add_loop_marks(GnuplotTable &table, const Rows rows, const PictureExtent &extent)
    {
      const Eigen::Vector2d center = extent.center();
      table.begin_block("head (degrees), tail (degrees), the label's place, phase (periods)");
      for (const double phase : {0., 0.25, 0.5, 0.75})
      {
        const auto [x, y]     = loop_point(rows[row_at_phase(rows, phase)]);
        const double distance = std::hypot(x - center.x(), y - center.y());
        const double outwards = distance > 0. ? 0.045 * extent.size() / distance : 0.;
        table.add_row({x, y, x + outwards * (x - center.x()), y + outwards * (y - center.y()), phase});
      }
      table.begin_block("head (degrees), tail (degrees), a short step along the loop");
      for (const double phase : {0.125, 0.375, 0.625, 0.875})
      {
        const std::size_t i   = std::max<std::size_t>(row_at_phase(rows, phase), 1);
        const auto [x0, y0]   = loop_point(rows[i - 1]);
        const auto [x, y]     = loop_point(rows[i]);
        const double distance = std::hypot(x - x0, y - y0);
        const double step     = distance > 0. ? 1e-3 * extent.size() / distance : 0.;
        table.add_row({x, y, step * (x - x0), step * (y - y0)});
      }
    }

    /// The SI prefix that brings a power to numbers between 1 and 1000.
    struct PowerUnit
    {
      std::string name;
      double      factor = 1.;
    };

    /// In two dimensions powers are per depth.
    PowerUnit power_unit(const Rows rows, const int dimension)
    {
      double largest = 0.;
      for (const TrajectoryRow &row : rows)
        largest = std::max({largest, std::abs(row.magnetic_power_W_m), std::abs(row.external_power_W_m),
                            std::abs(row.dissipation_W_m)});
      for (const IntervalPower &power : interval_powers(rows))
        largest = std::max(largest, std::abs(power.stored_rate_W_m));
      const std::string per_depth = dimension == 2 ? "/m" : "";
      if (largest >= 1.)
        return {"W" + per_depth, 1.};
      if (largest >= 1e-3)
        return {"mW" + per_depth, 1e3};
      if (largest >= 1e-6)
        return {"µW" + per_depth, 1e6};
      return largest >= 1e-9 || dimension == 2 ? PowerUnit{"nW" + per_depth, 1e9} : PowerUnit{"pW", 1e12};
    }

    std::string balance_finding(const ShownRun &run)
    {
      if (!run.summary.power_imbalance)
        return "no imbalance: " + why_no_imbalance(run.summary);
      const bool magnetic = any_nonzero(run.trajectory, &TrajectoryRow::magnetic_power_W_m);
      return fmt::format("imbalance {} % of the {} of {}", signed_number(percent * *run.summary.power_imbalance, 2),
                         magnetic ? "magnetic work" : "dissipation",
                         run.axis.periodic ? "the last full period" : "the whole run");
    }

    void set_shown_powers(GnuplotPicture &picture, const Rows rows)
    {
      picture.set_flag("has_magnetic", any_nonzero(rows, &TrajectoryRow::magnetic_power_W_m));
      picture.set_flag("has_external", any_nonzero(rows, &TrajectoryRow::external_power_W_m));
      picture.set_flag("has_dissipation", any_nonzero(rows, &TrajectoryRow::dissipation_W_m));
      picture.set_flag("has_stored", any_nonzero(rows, &TrajectoryRow::elastic_energy_J_m) ||
                                         any_nonzero(rows, &TrajectoryRow::kinetic_energy_J_m));
    }
  } // namespace

  GnuplotPicture trajectory_picture(const ShownRun &run)
  {
    GnuplotPicture picture  = make_picture(run, "trajectory", gnuplot_scripts::trajectory,
                                           "Path and displacement of the head", displacement_finding(run));
    const auto     add_rows = [&](const auto &rows) {
      picture.table.begin_block(run.axis.label + ", x (mm), y (mm), displacement head first (mm)");
      for (const TrajectoryRow &row : rows)
        picture.table.add_row(
                {run.time(row.time_s), mm * row.head_x_m, mm * row.head_y_m, mm * displacement_m(run.trajectory, row)});
    };
    add_rows(run.trajectory);
    add_rows(period_borders(run));

    PictureExtent extent(1e-3 * mm * run.scene.body_length_m());
    for (const TrajectoryRow &row : run.trajectory)
      extent.add(mm * Eigen::Vector2d(row.head_x_m, row.head_y_m));
    extent.set_in(picture);
    set_time_axis(picture, run, run.trajectory);
    picture.set("head_first", run.trajectory.front().head_angle_rad + std::numbers::pi);
    picture.set_text("border_title", run.axis.periodic ? "period boundaries" : "start and end");
    return picture;
  }

  GnuplotPicture angles_picture(const ShownRun &run)
  {
    const bool     cut     = n_full_periods(run.trajectory, run.axis) > n_periods_of_angles;
    const Rows     rows    = cut ? last_periods(run.trajectory, run.axis, n_periods_of_angles) : Rows(run.trajectory);
    GnuplotPicture picture = make_picture(run, "angles", gnuplot_scripts::angles, angles_heading(run),
                                          cut ? fmt::format("the last {} full periods", n_periods_of_angles) : "");
    picture.table.begin_block(run.axis.label + ", head (degrees), tail tip (degrees), b_x (mT), b_y (mT)");
    for (const TrajectoryRow &row : rows)
      picture.table.add_row({run.time(row.time_s), degrees * row.head_angle_rad, degrees * row.tail_angle_rad,
                             mT * row.bx_T, mT * row.by_T});
    set_time_axis(picture, run, rows);
    picture.set_flag("has_head", run.head_moves());
    picture.set_flag("has_tail", run.has_tail());
    picture.set_flag("has_field", any_nonzero(rows, &TrajectoryRow::bx_T) || any_nonzero(rows, &TrajectoryRow::by_T));
    return picture;
  }

  GnuplotPicture stroke_loop_picture(const ShownRun &run)
  {
    const Rows     rows    = run.last_period();
    GnuplotPicture picture = make_picture(run, "stroke_loop", gnuplot_scripts::stroke_loop,
                                          "Stroke loop: tail angle against head angle", loop_finding(rows));
    PictureExtent  extent(1e-3);
    const auto     add_rows = [&](const Rows shown) {
      picture.table.begin_block("head (degrees), tail tip (degrees)");
      for (const TrajectoryRow &row : shown)
      {
        const auto [x, y] = loop_point(row);
        picture.table.add_row({x, y});
        extent.add({x, y});
      }
    };
    add_rows(run.trajectory);
    add_rows(rows);
    extent.set_in(picture);
    add_loop_marks(picture.table, rows, extent);
    picture.set_text("earlier_title", rows.size() < run.trajectory.size() ? "whole run" : "");
    picture.set_text("loop_title", "last full period");
    return picture;
  }

  GnuplotPicture power_balance_picture(const ShownRun &run)
  {
    const Rows rows =
        last_periods(run.trajectory, run.axis, std::min(n_periods_of_power, n_full_periods(run.trajectory, run.axis)));
    const PowerUnit unit  = power_unit(rows, run.scene.dimension);
    const double    scale = power_scale_W_m(run.last_period());
    GnuplotPicture  picture =
        make_picture(run, "power_balance", gnuplot_scripts::power_balance, "Power balance", balance_finding(run));
    picture.table.begin_block(
        fmt::format("{0}, magnetic ({1}), external ({1}), dissipation ({1})", run.axis.label, unit.name));
    for (const TrajectoryRow &row : rows)
      picture.table.add_row({run.time(row.time_s), unit.factor * row.magnetic_power_W_m,
                             unit.factor * row.external_power_W_m, unit.factor * row.dissipation_W_m});
    picture.table.begin_block(fmt::format("{}, rate of stored energy ({}), residual (%)", run.axis.label, unit.name));
    for (const IntervalPower &power : interval_powers(rows))
      picture.table.add_row({run.time(power.time_s), unit.factor * power.stored_rate_W_m,
                             scale > 0. ? percent * power.residual_W_m / scale : 0.});
    set_time_axis(picture, run, rows);
    set_shown_powers(picture, rows);
    picture.set_flag("has_residual", scale > 0.);
    picture.set_text("power_name", run.scene.dimension == 3 ? "power" : "power per depth");
    picture.set_text("power_unit", unit.name);
    picture.set_text("residual_title", "power in − dissipation − rate of stored energy, in % of the mean power");
    return picture;
  }

  bool has_power(const Trajectory &trajectory)
  {
    return any_nonzero(trajectory, &TrajectoryRow::magnetic_power_W_m) ||
           any_nonzero(trajectory, &TrajectoryRow::external_power_W_m) ||
           any_nonzero(trajectory, &TrajectoryRow::dissipation_W_m);
  }
} // namespace swimtwin
