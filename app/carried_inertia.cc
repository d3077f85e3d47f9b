#include <app/carried_inertia.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/system/error.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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

  Scene scene_with_inertia(const ReducedModel &model, const std::string &inertia)
  {
    std::vector<std::string> overrides;
    if (!inertia.empty())
      overrides.push_back("fluid.inertia=" + inertia);
    return parse_scene(model.scene_text, model.scene_name + ".toml", overrides);
  }

  InertiaTerms carried_inertia(const Scene &scene, const ReducedModel &model, const std::string &model_name,
                               const std::string &inertia, const InertialExtreme &extreme)
  {
    if (!model.inertia.is_given() && inertia == "full")
      throw InputError(
          fmt::format("--inertia full: {} was trained without inertia; train it again with [fluid] inertia "
                      "= \"auto\" or \"full\", or leave --inertia out.",
                      model_name));
    if (!model.inertia.is_given())
      return {};
    const InertiaTerms terms = inertia_terms(scene, extreme.shares(scene));
    if (scene.fluid->inertia == Inertia::automatic && terms.any())
      return {.unsteady = true, .convective = true, .tail = true, .head = true}; // all cost the same as one
    return terms;
  }

  void add_inertia_option(CLI::App &verb, std::string &inertia)
  {
    verb.add_option("--inertia", inertia, "none, auto or full, in the place of the scene's [fluid] inertia")
        ->check(CLI::IsMember({"none", "auto", "full"}))
        ->take_last();
  }
} // namespace swimtwin
