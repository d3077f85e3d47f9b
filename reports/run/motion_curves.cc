#include <reports/run/motion_curves.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double period_round_off = 1e-9;
  } // namespace

  TimeAxis time_axis(const Scene &scene, const Trajectory &trajectory)
  {
    const double start_s  = trajectory.front().time_s;
    const double period_s = scene.field.period_s();
    if (period_s > 0.)
      return {start_s, period_s, true, fmt::format("time (periods of {:.4g} s)", period_s)};
    return {0., 1., false, "time (s)"};
  }

  int n_full_periods(const Trajectory &trajectory, const TimeAxis &axis)
  {
    return axis.periodic ? static_cast<int>(axis(trajectory.back().time_s) * (1. + period_round_off)) : 0;
  }

  Rows last_periods(const Trajectory &trajectory, const TimeAxis &axis, const int n_periods)
  {
    const int n_full = n_full_periods(trajectory, axis);
    if (n_periods < 1 || n_periods > n_full)
      return trajectory;
    const double begin = n_full - n_periods, end = n_full, margin = period_round_off * end;
    std::size_t  first = 0, last = trajectory.size() - 1;
    while (axis(trajectory[first].time_s) < begin - margin)
      ++first;
    while (axis(trajectory[last].time_s) > end + margin)
      --last;
    return Rows(trajectory).subspan(first, last - first + 1);
  }

  double displacement_m(const Trajectory &trajectory, const TrajectoryRow &row)
  {
    const TrajectoryRow &start = trajectory.front();
    return -std::cos(start.head_angle_rad) * (row.head_x_m - start.head_x_m) -
           std::sin(start.head_angle_rad) * (row.head_y_m - start.head_y_m);
  }

  double stroke_loop_area_rad2(const Rows rows)
  {
    double twice_area = 0.;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const TrajectoryRow &a = rows[i], &b = rows[(i + 1) % rows.size()];
      twice_area += a.head_angle_rad * b.tail_angle_rad - b.head_angle_rad * a.tail_angle_rad;
    }
    return 0.5 * twice_area;
  }

  std::vector<IntervalPower> interval_powers(const Rows rows)
  {
    const auto net_power_W_m = [](const TrajectoryRow &row) {
      return row.magnetic_power_W_m + row.external_power_W_m - row.dissipation_W_m - row.stabilization_W_m -
             row.kinetic_outflow_W_m;
    };
    std::vector<IntervalPower> powers;
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const TrajectoryRow &a = rows[i - 1], &b = rows[i];
      if (b.time_s <= a.time_s)
        continue;
      const double stored_rate =
          (b.elastic_energy_J_m + b.kinetic_energy_J_m - a.elastic_energy_J_m - a.kinetic_energy_J_m) /
          (b.time_s - a.time_s);
      powers.push_back(
          {0.5 * (a.time_s + b.time_s), stored_rate, 0.5 * (net_power_W_m(a) + net_power_W_m(b)) - stored_rate});
    }
    return powers;
  }

  double power_scale_W_m(const Rows rows)
  {
    return work_balance(rows).scale_J_m() / (rows.back().time_s - rows.front().time_s);
  }
} // namespace swimtwin
