// The adjoint's derivatives beside central differences: its self-check.
#pragma once

#include <rom/sensitivity/adjoint_integrator.h>

#include <vector>

namespace swimtwin
{
  struct AdjointCheck
  {
    Parameter parameter;
    double    by_adjoint = 0., by_differences = 0.;
    double    scale = 0.; ///< of the parameter
  };

  /// What counts as a change of a parameter of a swimmer of this length (m): its own size, that of the largest of its
  /// kind for the field and for a tail that is not magnetic, a radian or a stroke for the initial state.
  double parameter_scale(const RunRequest &request, const Parameter &parameter, double length_m);

  /// Differences of fourth order over this part of each parameter's scale: its fourth power is left out, and the
  /// motion's own error counts over it.
  std::vector<AdjointCheck> check_adjoint(AdjointIntegrator &integrator, const RunRequest &request,
                                          const MotionFunctional &functional, const std::vector<Parameter> &parameters,
                                          double relative_step = 1e-2);

  /// Largest difference, per scale of the parameters, relative to the largest derivative.
  double largest_error(const std::vector<AdjointCheck> &checks);
} // namespace swimtwin
