#include <datasets/scene/inertia_terms.h>
#include <twin/motion/carried_densities.h>

namespace swimtwin
{
  std::string read_inertia(TomlTable &top, const ReducedModel &model)
  {
    std::string choice = "auto";
    top.word("inertia", Need::optional, {"none", "auto", "full"}, choice);
    if (choice == "full" && !model.inertia.is_given())
      top.note("inertia", "asks for what the model was trained without; train it again with [fluid] inertia = \"auto\" "
                          "in its scene, or say \"none\".");
    return choice;
  }

  InertialDensities carried_densities(const std::string &choice, const ReducedModel &model, const Scene &scene,
                                      const SwimmerParameters &swimmer, const double frequency_Hz)
  {
    const double share =
        inertia_shares(scene, frequency_Hz, swimmer.viscosity_Pa_s, swimmer.young_modulus_Pa).together();
    if (choice == "none" || !model.inertia.is_given() || (choice == "auto" && share <= negligible_share))
      return {};
    return inertial_densities(scene, {.unsteady = true, .convective = true, .tail = true, .head = true});
  }
} // namespace swimtwin
