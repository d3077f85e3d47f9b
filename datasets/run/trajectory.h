// The motion of a swimmer over time and the figures that sum it up.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// One instant. Positions in m, angles in rad (unwrapped). In two dimensions powers are per unit depth in W/m, forces
  /// in N/m, torques in N, as the names say; in three they are whole, in W, N and N m, and so are the names in files.
  struct TrajectoryRow
  {
    double time_s   = 0.;
    double head_x_m = 0., head_y_m = 0., head_angle_rad = 0.;
    double tail_tip_x_m = 0., tail_tip_y_m = 0., tail_angle_rad = 0.;
    double bx_T = 0., by_T = 0.;
    double magnetic_power_W_m  = 0.; ///< power of the magnetic field on head and tail
    double external_power_W_m  = 0.; ///< power of gravity, moving walls, inflows and prescribed motions
    double dissipation_W_m     = 0.; ///< viscous
    double elastic_energy_J_m  = 0.; ///< of the tail
    double kinetic_energy_J_m  = 0.; ///< of fluid and body, as far as the run has inertia
    double kinetic_outflow_W_m = 0.; ///< kinetic energy that leaves the domain with the fluid
    double kinetic_growth_W_m =
        0.; ///< power on inertia in the time step; what of it is not stored is numerical dissipation
    double stabilization_W_m = 0.; ///< dissipated to keep streams smooth where cells are too large
    double head_force_x_N_m = 0., head_force_y_N_m = 0.,
           head_torque_N     = 0.; ///< that hold a fixed head in place, or drive a prescribed one; else 0
    double fluid_force_x_N_m = 0., fluid_force_y_N_m = 0.,
           fluid_torque_N    = 0.; ///< of the fluid on the body, about the head's centre
    int  coupling_iterations = 0;
    int  n_unknowns          = 0;
    bool remeshed            = false; ///< the step to this instant made a new fluid mesh

    // In three dimensions only: whole quantities.
    double head_z_m = 0., tail_tip_z_m = 0.;
    double head_qw = 1., head_qx = 0., head_qy = 0., head_qz = 0.; ///< rotation of the head: a unit quaternion
    double bz_T           = 0.;
    double head_force_z_N = 0., head_torque_x_N_m = 0., head_torque_y_N_m = 0.;
    double fluid_force_z_N = 0., fluid_torque_x_N_m = 0., fluid_torque_y_N_m = 0.;
  };

  using Trajectory = std::vector<TrajectoryRow>;

  /// All fields of a row as numbers, in the order of the columns of trajectory.csv, and back.
  std::vector<double> numbers_of(const TrajectoryRow &row);
  TrajectoryRow       row_of(const std::vector<double> &numbers);

  /// Works and stored energy over a stretch of time, per unit depth (datasets/run/work_balance.h).
  struct WorkBalance
  {
    double magnetic_J_m = 0., external_J_m = 0., dissipated_J_m = 0.;
    double stored_J_m        = 0.; ///< gain of elastic and kinetic energy
    double outflow_J_m       = 0.; ///< kinetic energy that left with the fluid
    double stabilization_J_m = 0.; ///< dissipated by what keeps streams smooth
    double numerical_J_m     = 0.; ///< that the time steps took from inertia: it is part of what is missing

    double missing_J_m() const
    {
      return magnetic_J_m + external_J_m - dissipated_J_m - stabilization_J_m - outflow_J_m - stored_J_m;
    }
    /// What it is compared with: the magnetic work, or the dissipation where the field does none (below round-off of
    /// the dissipation). Zero: there is nothing to balance.
    double                scale_J_m() const;
    std::optional<double> imbalance() const; ///< missing / scale; none without a scale
  };

  /// What a run kept of inertia, and what each term was estimated to be worth: shares of the displacement per period
  /// (datasets/scene/inertia_terms.h).
  struct InertiaRecord
  {
    std::vector<std::string> kept; ///< terms by their names in [fluid] inertia
    double                   fluid_share = 0., tail_share = 0., head_share = 0.;
    double                   neglected_share = 0.; ///< of terms that nobody said to leave out
  };

  /// What summary.json holds beside provenance. An optional that is empty was not computed.
  struct RunSummary
  {
    std::string           status = "not run";        ///< "completed", "failed: <cause>"
    std::vector<double>   displacement_per_period_m; ///< of the head's centre, along the initial head-first direction
    std::optional<double> net_displacement_m;        ///< of the last full period; none without one
    int                   n_unknowns = 0, n_steps = 0, n_linear_solves = 0, n_factorizations = 0;
    int                   n_tail_linear_solves = 0, n_tail_factorizations = 0; ///< of those, on the tail alone
    std::optional<double> linear_iterations_mean;   ///< per solve; none without one, and in runs of earlier versions
    std::optional<double> coupling_iterations_mean; ///< per step; none without a step
    int                   n_remeshes = 0, n_step_halvings = 0;
    std::optional<double> power_imbalance; ///< over the last full period, relative to its magnetic work; none without
                                           ///< a period, and without work and dissipation
    std::optional<double>                       worst_power_imbalance; ///< worst single period
    std::optional<WorkBalance>                  work_of_last_period;
    std::optional<InertiaRecord>                inertia; ///< none without a fluid
    double                                      wall_time_s = 0., cpu_time_s = 0., peak_memory_MB = 0.;
    std::vector<std::pair<std::string, double>> cpu_time_of_part_s; ///< assembly, factorisation, ...
    std::vector<std::string>                    warnings; ///< why the result may not be trusted, one sentence each
  };

  /// Index of the row at every full multiple of the period after the first row, that one included. Throws InputError if
  /// one is missing.
  std::vector<std::size_t> period_borders(const Trajectory &trajectory, double period_s);

  /// Displacements by period from the rows, and the balances of the periods; counters are left as they are.
  /// `initial_angle_rad` fixes the head-first direction -(cos, sin). Needs rows at every multiple of the period.
  void summarize_motion(const Trajectory &trajectory, double period_s, double initial_angle_rad,
                        const std::vector<WorkBalance> &periods, RunSummary &summary);
  /// The same with balances from the powers of the rows alone.
  void summarize_motion(const Trajectory &trajectory, double period_s, double initial_angle_rad, RunSummary &summary);

  /// CSV with a header line of the field names above; the numbers read back the same. In three dimensions units in
  /// names are those of whole quantities, and z and the rotation as a unit quaternion are added; where the field has a
  /// component along z, that and the forces and torques out of the plane as well. ComputationError for a number that is
  /// not finite.
  void       write_trajectory_csv(const std::filesystem::path &file, const Trajectory &trajectory, int dimension = 2);
  Trajectory read_trajectory_csv(const std::filesystem::path &file);
} // namespace swimtwin
