// How accurately to integrate, and what to integrate beside the state.
#pragma once

#include <rom/swimmer/swimmer_parameters.h>

#include <vector>

namespace swimtwin
{
  struct IntegratorOptions
  {
    /// Local error per step. Absolute tolerances are this in rad, and times a stroke (0.03 body lengths) for lengths.
    double                 relative_tolerance = 1e-6;
    double                 max_step_periods   = 0.05;
    long                   max_steps          = 200'000; ///< per run
    bool                   with_work          = false;   ///< integrate magnetic work and dissipation too
    std::vector<Parameter> sensitivities      = {};      ///< the state's derivatives by these are integrated with it
    bool control_sensitivity_errors = true; ///< like the state's; without, they are as good as the state's steps
  };
} // namespace swimtwin
