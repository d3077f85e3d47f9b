#include <rom/sensitivity/period_start.h>

namespace swimtwin
{
  std::vector<Parameter> start_parameters(const ReducedSwimmer &swimmer)
  {
    std::vector<Parameter> parameters = {{Quantity::initial_angle, 0}};
    for (int k = 0; k < swimmer.n_modes(); ++k)
      parameters.push_back({Quantity::initial_shape, k});
    for (int k = 0; swimmer.has_inertia() && k < swimmer.n_velocities(); ++k)
      parameters.push_back({Quantity::initial_velocity, k});
    return parameters;
  }

  Eigen::VectorXd start_units(const ReducedSwimmer &swimmer, const double frequency_Hz)
  {
    const Eigen::Index n     = swimmer.n_velocities();
    Eigen::VectorXd    units = Eigen::VectorXd::Constant(swimmer.n_states() - 2, swimmer.length_m());
    units[0]                 = 1.;
    if (swimmer.has_inertia())
    {
      units[n] = 1.;
      units.tail(n) *= frequency_Hz;
    }
    return units;
  }
} // namespace swimtwin
