#include <datasets/system/error.h>
#include <rom/swimmer/swimmer_parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  SwimmerParameters swimmer_parameters(const Scene &scene)
  {
    if (!scene.fluid || !scene.tail)
      throw InputError(fmt::format("the scene {} has no {}: there is no swimmer to reduce.", scene.name,
                                   scene.fluid ? "tail" : "fluid"));
    return {scene.tail->young_modulus_Pa, scene.fluid->viscosity_Pa_s, scene.head.magnetization_A_m,
            scene.tail->magnetization_A_m};
  }

  InertialDensities inertial_densities(const Scene &scene, const InertiaTerms &terms)
  {
    if (terms.unsteady != terms.convective)
      throw InputError("[fluid] inertia of a reduced swimmer must name \"unsteady\" and \"convective\" together, or "
                       "neither: name both, or simulate the scene.");
    return {terms.unsteady ? scene.fluid->density_kg_m3 : 0., terms.tail ? scene.tail->density_kg_m3 : 0.,
            terms.head ? scene.head.density_kg_m3 : 0.};
  }

  double error_of_carried_inertia(const double share, const double unsteady_group_of_domain)
  {
    constexpr double carried_well = 4.; // group up to which the second order does not show
    return 0.04 * share * std::max(1., std::pow(unsteady_group_of_domain / carried_well, 2));
  }
} // namespace swimtwin
