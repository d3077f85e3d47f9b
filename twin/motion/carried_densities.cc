#include <datasets/scene/inertia_terms.h>
#include <twin/motion/carried_densities.h>

namespace swimtwin
{
  InertialDensities carried_densities(const std::string &choice, const ReducedModel &model, const Scene &scene,
                                      const double frequency_Hz)
  {
    const double share =
        inertia_shares(scene, frequency_Hz, scene.fluid->viscosity_Pa_s, scene.tail->young_modulus_Pa).together();
    if (choice == "none" || (choice == "auto" && (share <= negligible_share || !model.inertia.is_given())))
      return {};
    return inertial_densities(scene, {.unsteady = true, .convective = true, .tail = true, .head = true});
  }
} // namespace swimtwin
