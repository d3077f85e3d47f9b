// A made-up motion with the size of the reference swimmer's, to draw. It solves no equation.
#pragma once

#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/scene.h>
#include <tests/datasets/example_scenes.h>

#include <array>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  inline Scene synthetic_scene(const std::vector<std::string> &overrides = {})
  {
    return parse_scene(swimmer_toml, "synthetic.toml", overrides);
  }

  /// Of the point (x, y) of a tail that is bent to a parabola whose tip has turned by `bend` (rad), in the head's
  /// frame.
  inline std::array<double, 2> synthetic_displacement(const double x_m, const double y_m, const double bend)
  {
    const double s = (x_m - 0.25e-3) / 7.5e-3, angle = bend * s;
    return {-y_m * std::sin(angle) - 1.2e-3 * bend * bend * s * s * s,
            3.75e-3 * bend * s * s + y_m * (std::cos(angle) - 1.)};
  }

  /// Head +-27 degrees, tail +-28 degrees behind it by a fifth of a period, 0.17 mm head first per period and 0.2 mm
  /// back and forth twice per period. The power balance closes but for `leak` times the dissipation.
  inline TrajectoryRow synthetic_row(const double time_s, const double period_s, const double leak = 0.)
  {
    const double  pi = std::numbers::pi, omega = 2. * pi / period_s, phase = omega * time_s;
    const double  rise = 1. - std::exp(-2. * time_s / period_s), power = 4e-4;
    TrajectoryRow row;
    row.time_s                      = time_s;
    row.head_angle_rad              = 27. / 180. * pi * rise * std::sin(phase - 0.6);
    row.tail_angle_rad              = 28. / 180. * pi * rise * std::sin(phase - 0.6 - 0.4 * pi);
    row.head_x_m                    = -0.17e-3 * time_s / period_s + 0.1e-3 * rise * (std::cos(2. * phase) - 1.);
    row.head_y_m                    = 0.15e-3 * rise * std::sin(phase - 0.2) + 5e-6 * time_s / period_s;
    row.bx_T                        = 5e-3;
    row.by_T                        = 5e-3 * std::sin(phase);
    row.dissipation_W_m             = power * (1. + leak - 0.7 * std::cos(2. * phase));
    row.elastic_energy_J_m          = 0.2 * power / omega * (1. - std::cos(2. * phase - 1.));
    row.magnetic_power_W_m          = power * (1. - 0.7 * std::cos(2. * phase) + 0.4 * std::sin(2. * phase - 1.));
    const std::array<double, 2> tip = synthetic_displacement(7.75e-3, 0., row.tail_angle_rad - row.head_angle_rad);
    const double                c = std::cos(row.head_angle_rad), s = std::sin(row.head_angle_rad);
    row.tail_tip_x_m = row.head_x_m + c * (7.75e-3 + tip[0]) - s * tip[1];
    row.tail_tip_y_m = row.head_y_m + s * (7.75e-3 + tip[0]) + c * tip[1];
    return row;
  }

  inline Trajectory synthetic_trajectory(const double period_s, const int n_steps, const int steps_per_period,
                                         const double leak = 0.)
  {
    Trajectory trajectory;
    for (int i = 0; i <= n_steps; ++i)
      trajectory.push_back(synthetic_row(i * period_s / steps_per_period, period_s, leak));
    return trajectory;
  }

  /// Quadratic triangles on the reference taper, two per cell of an n x 1 grid.
  inline SnapshotSet synthetic_snapshots(const Trajectory &trajectory, const int every, const int n = 30)
  {
    SnapshotSet set;
    const auto  node = [](const int i, const int j) { return 3 * i + j; };
    set.tail_nodes_m.resize(3 * (2 * n + 1), 2);
    set.tail_cells.resize(2 * n, 6);
    for (int i = 0; i <= 2 * n; ++i)
      for (int j = 0; j < 3; ++j)
      {
        const double s                  = 0.5 * i / n;
        set.tail_nodes_m(node(i, j), 0) = 0.25e-3 + 7.5e-3 * s;
        set.tail_nodes_m(node(i, j), 1) = 0.5 * (j - 1) * (1.5e-3 - 1.3e-3 * s);
      }
    for (int i = 0; i < n; ++i)
    {
      const int a = 2 * i, b = a + 1, c = a + 2;
      set.tail_cells.row(2 * i) << node(a, 0), node(c, 0), node(c, 2), node(b, 0), node(c, 1), node(b, 1);
      set.tail_cells.row(2 * i + 1) << node(a, 0), node(c, 2), node(a, 2), node(b, 1), node(b, 2), node(a, 1);
    }
    const auto n_snapshots = static_cast<Eigen::Index>((trajectory.size() - 1) / static_cast<std::size_t>(every) + 1);
    set.tail_displacement_m.setZero(n_snapshots, 2 * set.tail_nodes_m.rows());
    set.pose.resize(n_snapshots, 3);
    for (Eigen::Index k = 0; k < n_snapshots; ++k)
    {
      const TrajectoryRow &row = trajectory[static_cast<std::size_t>(k * every)];
      set.time_s.push_back(row.time_s);
      set.pose.row(k) << row.head_x_m, row.head_y_m, row.head_angle_rad;
      const double bend = row.tail_angle_rad - row.head_angle_rad;
      for (Eigen::Index i = 0; i < set.tail_nodes_m.rows(); ++i)
      {
        const auto [x, y] = synthetic_displacement(set.tail_nodes_m(i, 0), set.tail_nodes_m(i, 1), bend);
        set.tail_displacement_m(k, 2 * i)     = x;
        set.tail_displacement_m(k, 2 * i + 1) = y;
      }
    }
    return set;
  }
} // namespace swimtwin
