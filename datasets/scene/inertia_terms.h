// Which terms of inertia a scene's run carries, and how much of the displacement each is worth.
#pragma once

#include <datasets/scene/scene.h>

namespace swimtwin
{
  inline constexpr InertiaTerms all_inertia{.unsteady = true, .convective = true, .tail = true, .head = true};

  /// The terms that [fluid] inertia asks for, less those of what the scene does not have or does not move. "auto" keeps
  /// each whose share is above `negligible_share`, and none with a partitioned coupling, which cannot carry any. In
  /// vacuum it is [tail] inertia that asks.
  InertiaTerms inertia_terms(const Scene &scene);

  struct InertiaShares;
  /// The same where each term is estimated to be worth these shares.
  InertiaTerms inertia_terms(const Scene &scene, const InertiaShares &shares);

  /// Their names in a scene file.
  std::vector<std::string> names_of(const InertiaTerms &terms);

  /// The entry of a scene that asks for those of these names, as an override.
  std::string inertia_override(const std::vector<std::string> &names);

  constexpr double negligible_share = 2e-3;

  /// Estimated share of the displacement per period that leaving out a term loses, 0 to 1; rather too large than too
  /// small (docs/equations.md, section 12).
  struct InertiaShares
  {
    double fluid = 0., tail = 0., head = 0.;

    double together() const;
  };

  /// Of a scene with a fluid; zero without.
  InertiaShares inertia_shares(const Scene &scene);
  /// The same for another frequency, viscosity and Young's modulus.
  InertiaShares inertia_shares(const Scene &scene, double frequency_Hz, double viscosity_Pa_s, double young_modulus_Pa);

  /// Of the shares above, those of terms that the run leaves out without having been told to.
  double neglected_share(const Scene &scene);
} // namespace swimtwin
