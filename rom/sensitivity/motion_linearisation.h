// A motion and how it changes with some parameters of its field, at chosen instants.
#pragma once

#include <rom/integration/phase_equations.h>
#include <rom/integration/stored_motion.h>

#include <vector>

namespace swimtwin
{
  struct LinearisedInstant
  {
    double          phase = 0.;
    Eigen::VectorXd state;                  ///< r + 3, SI
    Eigen::MatrixXd by_parameters;          ///< (r + 3) x n_parameters
    Eigen::VectorXd integral;               ///< of the state over phase, since the start
    Eigen::MatrixXd integral_by_parameters; ///< (r + 3) x n_parameters
  };

  /// At the start and at each of the increasing phases in (0, n_periods], by all parameters of the field that the
  /// equations were started with; the initial state stays. Collocation steps of order 5 (Radau IIA), no longer than
  /// eight steps of the motion, lead from each instant to the next.
  std::vector<LinearisedInstant> linearise_motion(PhaseEquations &equations, const StoredMotion &motion,
                                                  const std::vector<double> &phases);
} // namespace swimtwin
