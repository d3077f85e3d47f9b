// One run of the reduced swimmer: what is asked, and what comes back.
#pragma once

#include <datasets/run/trajectory.h>
#include <rom/swimmer/state_vectors.h>
#include <rom/swimmer/swimmer_parameters.h>

#include <string>
#include <vector>

namespace swimtwin
{
  struct RunRequest
  {
    SwimmerParameters parameters;
    Drive             drive;
    SwimmerState      initial_state;
    int               n_periods          = 3;
    int               samples_per_period = 0; ///< rows of the trajectory; 0: none
  };

  struct ReducedSnapshot
  {
    double         phase = 0.; ///< periods since the start
    SwimmerState   state;
    VelocityVector rate; ///< d state / dt
  };

  /// Work over one period, per unit depth (J/m).
  struct PeriodWork
  {
    double magnetic = 0., dissipated = 0.;
    double elastic_change = 0.; ///< of the stored energy
    double kinetic_change = 0.; ///< of the kinetic energy, with inertia

    /// What does not add up, relative to the magnetic work, or to the dissipation where the field does none.
    double imbalance() const;
  };

  enum class RunStatus { not_run, completed, failed };

  struct SwimmerRun
  {
    RunStatus   status = RunStatus::not_run;
    std::string failure; ///< one sentence

    std::vector<SwimmerState>    at_period_end;             ///< the initial state, then one per completed period
    std::vector<Eigen::MatrixXd> sensitivity_at_period_end; ///< the same; states x number of parameters, SI
    std::vector<PeriodWork>      work;                      ///< per period, if asked for
    Trajectory                   trajectory;
    std::vector<ReducedSnapshot> snapshots;                ///< of every row of the trajectory
    std::vector<Eigen::MatrixXd> sensitivity_at_snapshots; ///< as at the periods' ends

    double largest_shape_radius = 0., largest_angle_radius = 0.,
           largest_height_radius = 0.; ///< above 1: outside the trained region
    long n_steps = 0, n_rate_evaluations = 0, n_jacobians = 0;

    bool completed() const { return status == RunStatus::completed; }
  };

  /// Displacement (m) of the head in each period, positive head first for a swimmer of this heading: along
  /// -(cos heading, sin heading).
  std::vector<double> displacement_per_period(const SwimmerRun &run, double heading_rad);
  /// Their derivatives by the parameters of the run's sensitivities, n_periods x n_parameters; the direction stays.
  Eigen::MatrixXd displacement_sensitivities(const SwimmerRun &run, double heading_rad);
} // namespace swimtwin
