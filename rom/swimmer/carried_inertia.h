// Which inertia a study on a reduced model carries.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/inertia_terms.h>
#include <rom/swimmer/swimmer_parameters.h>

#include <string>

namespace swimtwin
{
  /// The member of a study that needs inertia most.
  struct InertialExtreme
  {
    double frequency_Hz, viscosity_Pa_s, young_modulus_Pa;

    double        group(const Scene &scene) const;
    double        group_of_domain(const Scene &scene) const;
    InertiaShares shares(const Scene &scene) const;
    double        error_if_carried(const Scene &scene) const; ///< error_of_carried_inertia
  };

  /// Error of displacements, by inertia that is carried approximately or left out without anyone having said so, up to
  /// which they are given without being asked for all the same.
  constexpr double largest_inertial_error = 0.05;

  InertialExtreme extreme_of(const SwimmerParameters &swimmer, double frequency_Hz);

  /// The model's scene with `inertia` ("none", "auto", "full"; empty: its own) in the place of [fluid] inertia.
  Scene scene_with_inertia(const ReducedModel &model, const std::string &inertia);

  /// What of the inertia all members carry: what the scene asks for, as far as the model has it. "auto" keeps all of it
  /// as soon as one of them needs a term.
  InertiaTerms carried_inertia(const Scene &scene, const ReducedModel &model, const InertialExtreme &extreme);

  /// The same with `inertia` as in scene_with_inertia.
  InertiaTerms carried_inertia(const ReducedModel &model, const std::string &inertia, const InertialExtreme &extreme);

  /// With the densities of the model's scene.
  InertialDensities inertial_densities(const ReducedModel &model, const InertiaTerms &terms);
} // namespace swimtwin
