#include <datasets/system/error.h>
#include <rom/sensitivity/adjoint_check.h>
#include <rom/swimmer/state_scale.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// The number of a request that a parameter stands for.
    double &value_of(RunRequest &request, const Parameter &parameter)
    {
      switch (parameter.quantity)
      {
      case Quantity::young_modulus:
        return request.parameters.young_modulus_Pa;
      case Quantity::viscosity:
        return request.parameters.viscosity_Pa_s;
      case Quantity::magnetization:
        return request.parameters.magnetization_A_m;
      case Quantity::tail_magnetization:
        return request.parameters.tail_magnetization_A_m;
      case Quantity::frequency:
        return request.drive.frequency_Hz;
      case Quantity::field:
        return request.drive.parameters[parameter.index];
      case Quantity::initial_angle:
        return request.initial_state[2];
      case Quantity::initial_velocity:
        return request.initial_state[request.initial_state.size() / 2 + parameter.index];
      case Quantity::initial_shape:
        break;
      }
      return request.initial_state[3 + parameter.index];
    }

    double value_at(AdjointIntegrator &integrator, RunRequest request, const MotionFunctional &functional,
                    const Parameter &parameter, const double change)
    {
      value_of(request, parameter) += change;
      const MotionGradient result = integrator.evaluate(request, functional);
      if (!result.completed())
        throw ComputationError(result.failure);
      return result.value;
    }
  } // namespace

  double parameter_scale(const RunRequest &request, const Parameter &parameter, const double length_m)
  {
    RunRequest   copy  = request;
    const double value = std::abs(value_of(copy, parameter));
    switch (parameter.quantity)
    {
    case Quantity::field:
      return request.drive.parameters.lpNorm<Eigen::Infinity>();
    case Quantity::initial_angle:
      return 1.;
    case Quantity::initial_shape:
      return stroke_per_length * length_m;
    case Quantity::tail_magnetization:
      return value > 0. ? value : std::abs(request.parameters.magnetization_A_m);
    default:
      return value;
    }
  }

  std::vector<AdjointCheck> check_adjoint(AdjointIntegrator &integrator, const RunRequest &request,
                                          const MotionFunctional &functional, const std::vector<Parameter> &parameters,
                                          const double relative_step)
  {
    const MotionGradient      gradient = integrator.differentiate(request, functional);
    std::vector<AdjointCheck> checks;
    for (const Parameter &parameter : parameters)
    {
      const double scale = parameter_scale(request, parameter, integrator.length_m()), h = relative_step * scale;
      const auto at = [&](const double change) { return value_at(integrator, request, functional, parameter, change); };
      const double slope = (8. * (at(h) - at(-h)) - (at(2. * h) - at(-2. * h))) / (12. * h);
      checks.push_back({parameter, gradient.by(parameter), slope, scale});
    }
    return checks;
  }

  double largest_error(const std::vector<AdjointCheck> &checks)
  {
    double error = 0., size = 0.;
    for (const AdjointCheck &check : checks)
    {
      error = std::max(error, check.scale * std::abs(check.by_adjoint - check.by_differences));
      size  = std::max(size, check.scale * std::abs(check.by_differences));
    }
    return size > 0. ? error / size : error;
  }
} // namespace swimtwin
