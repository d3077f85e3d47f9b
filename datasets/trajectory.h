// The motion of a swimmer over time and the figures that sum it up.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// One instant (2D). Positions in m, angles in rad (unwrapped), powers per unit depth in W/m, forces in N/m, torque
  /// in N.
  struct TrajectoryRow
  {
    double time_s   = 0.;
    double head_x_m = 0., head_y_m = 0., head_angle_rad = 0.;
    double tail_tip_x_m = 0., tail_tip_y_m = 0., tail_angle_rad = 0.;
    double bx_T = 0., by_T = 0.;
    double magnetic_power_W_m = 0.; ///< power of the magnetic field on head and tail
    double external_power_W_m = 0.; ///< power of gravity, of moving walls and of inflows
    double dissipation_W_m    = 0.; ///< viscous
    double elastic_energy_J_m = 0.; ///< of the tail
    double head_force_x_N_m = 0., head_force_y_N_m = 0.,
           head_torque_N     = 0.; ///< that hold a fixed head in place; else 0
    int  coupling_iterations = 0;
    int  n_unknowns          = 0;
    bool remeshed            = false; ///< the step to this instant made a new fluid mesh
  };

  using Trajectory = std::vector<TrajectoryRow>;

  /// All fields of a row as numbers, in the order of the columns of trajectory.csv, and back.
  std::vector<double> numbers_of(const TrajectoryRow &row);
  TrajectoryRow       row_of(const std::vector<double> &numbers);

  /// What summary.json holds beside provenance.
  struct RunSummary
  {
    std::string         status = "not run";        ///< "completed", "failed: <cause>"
    std::vector<double> displacement_per_period_m; ///< of the head's centre, along the initial head-first direction
    double              net_displacement_m = 0.;   ///< of the last full period
    int                 n_unknowns = 0, n_steps = 0, n_linear_solves = 0, n_factorizations = 0;
    int                 n_tail_linear_solves = 0, n_tail_factorizations = 0; ///< of those, on the tail alone
    double              coupling_iterations_mean = 0.;
    int                 n_remeshes = 0, n_step_halvings = 0;
    double              power_imbalance       = 0.; ///< over the last full period, relative to its magnetic work
    double              worst_power_imbalance = 0.; ///< worst single period
    double              wall_time_s = 0., cpu_time_s = 0., peak_memory_MB = 0.;
    std::vector<std::pair<std::string, double>> cpu_time_of_part_s; ///< assembly, factorisation, ...
    std::vector<std::string>                    warnings; ///< why the result may not be trusted, one sentence each
  };

  /// Displacements and power imbalances by period from the rows; counters are left as they are.
  /// `initial_angle_rad` fixes the head-first direction -(cos, sin). Needs rows at every multiple of the period.
  void summarize_motion(const Trajectory &trajectory, double period_s, double initial_angle_rad, RunSummary &summary);

  /// CSV with a header line of the field names above; the numbers read back the same. ComputationError for a number
  /// that is not finite.
  void       write_trajectory_csv(const std::filesystem::path &file, const Trajectory &trajectory);
  Trajectory read_trajectory_csv(const std::filesystem::path &file);
} // namespace swimtwin
