// Which inertia a study on a reduced model carries.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/inertia_terms.h>

#include <string>

namespace CLI
{
  class App;
}

namespace swimtwin
{
  /// The member of a study that needs inertia most.
  struct InertialExtreme
  {
    double frequency_Hz, viscosity_Pa_s, young_modulus_Pa;

    double        group(const Scene &scene) const;
    double        group_of_domain(const Scene &scene) const;
    InertiaShares shares(const Scene &scene) const;
  };

  /// The model's scene with `inertia` ("none", "auto", "full"; empty: its own) in the place of [fluid] inertia.
  Scene scene_with_inertia(const ReducedModel &model, const std::string &inertia);

  /// What of the inertia all members carry: what the scene asks for, as far as the model has it. "auto" keeps all of it
  /// as soon as one of them needs a term. Throws InputError for `inertia` = "full" and a model that has none.
  InertiaTerms carried_inertia(const Scene &scene, const ReducedModel &model, const std::string &model_name,
                               const std::string &inertia, const InertialExtreme &extreme);

  /// Option --inertia of a verb.
  void add_inertia_option(CLI::App &verb, std::string &inertia);
} // namespace swimtwin
