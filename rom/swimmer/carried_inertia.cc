#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <rom/swimmer/carried_inertia.h>

namespace swimtwin
{
  double InertialExtreme::group(const Scene &scene) const
  {
    return unsteady_group(scene, frequency_Hz, viscosity_Pa_s);
  }

  double InertialExtreme::group_of_domain(const Scene &scene) const
  {
    return unsteady_group_of_domain(scene, frequency_Hz, viscosity_Pa_s);
  }

  InertiaShares InertialExtreme::shares(const Scene &scene) const
  {
    return inertia_shares(scene, frequency_Hz, viscosity_Pa_s, young_modulus_Pa);
  }

  double InertialExtreme::error_if_carried(const Scene &scene) const
  {
    return error_of_carried_inertia(shares(scene).together(), group_of_domain(scene));
  }

  InertialExtreme extreme_of(const SwimmerParameters &swimmer, const double frequency_Hz)
  {
    return {frequency_Hz, swimmer.viscosity_Pa_s, swimmer.young_modulus_Pa};
  }

  Scene scene_with_inertia(const ReducedModel &model, const std::string &inertia)
  {
    std::vector<std::string> overrides;
    if (!inertia.empty())
      overrides.push_back("fluid.inertia=" + inertia);
    return parse_scene(model.scene_text, model.scene_name + ".toml", overrides);
  }

  InertiaTerms carried_inertia(const Scene &scene, const ReducedModel &model, const InertialExtreme &extreme)
  {
    if (!model.inertia.is_given())
      return {};
    const InertiaTerms terms = inertia_terms(scene, extreme.shares(scene));
    if (scene.fluid->inertia == Inertia::automatic && terms.any())
      return all_inertia; // all cost the same as one
    return terms;
  }

  InertiaTerms carried_inertia(const ReducedModel &model, const std::string &inertia, const InertialExtreme &extreme)
  {
    return carried_inertia(scene_with_inertia(model, inertia), model, extreme);
  }

  InertialDensities inertial_densities(const ReducedModel &model, const InertiaTerms &terms)
  {
    return terms.any() ? inertial_densities(scene_with_inertia(model, ""), terms) : InertialDensities();
  }
} // namespace swimtwin
