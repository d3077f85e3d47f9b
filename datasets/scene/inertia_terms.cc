#include <datasets/scene/inertia_terms.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/scene_names.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr InertiaTerms all_terms{.unsteady = true, .convective = true, .tail = true, .head = true};

    InertiaTerms chosen_by_share(const Scene &scene, const InertiaShares &shares)
    {
      if (scene.numerics.coupling == CouplingScheme::fixed_point && scene.tail)
        return {};
      const auto [fluid, tail, head] = shares;
      const bool has_fluid           = fluid > negligible_share;
      return {.unsteady   = has_fluid,
              .convective = has_fluid,
              .tail       = tail > negligible_share,
              .head       = head > negligible_share};
    }

    InertiaTerms asked_for(const Scene &scene, const InertiaShares &shares)
    {
      if (!scene.fluid)
        return {.tail = scene.tail && scene.tail->has_inertia_in_vacuum};
      switch (scene.fluid->inertia)
      {
      case Inertia::full:
        return all_terms;
      case Inertia::chosen:
        return scene.fluid->chosen;
      case Inertia::automatic:
        return chosen_by_share(scene, shares);
      case Inertia::none:
        return {};
      }
      return {};
    }

    double tail_area_m2(const Tail &tail)
    {
      return tail.length_m * tail.mean_height_m();
    }

    /// Share of a whole of which `odds` is the ratio to the rest.
    double share_of_odds(const double odds)
    {
      return odds / (1. + odds);
    }
  } // namespace

  InertiaTerms inertia_terms(const Scene &scene)
  {
    return inertia_terms(scene, inertia_shares(scene));
  }

  InertiaTerms inertia_terms(const Scene &scene, const InertiaShares &shares)
  {
    InertiaTerms terms = asked_for(scene, shares);
    terms.tail         = terms.tail && scene.tail && !scene.time.is_steady;
    terms.head         = terms.head && scene.head.motion != HeadMotion::fixed && !scene.time.is_steady;
    return terms;
  }

  std::vector<std::string> names_of(const InertiaTerms &terms)
  {
    std::vector<std::string> names;
    for (const auto &[name, term] : inertia_term_names)
      if (terms.*term)
        names.emplace_back(name);
    return names;
  }

  double InertiaShares::together() const
  {
    const auto odds = [](const double share) { return share < 1. ? share / (1. - share) : 1e300; };
    return share_of_odds(std::min(1e15, odds(fluid) + odds(tail) + odds(head)));
  }

  namespace
  {
    /// How much more fluid there is to be moved than around the reference swimmer in its box: as far as walls, or a
    /// flow that oscillates, let it. Measured in boxes of 20 to 80 mm and discs of 12 to 50 mm (docs/study.md).
    double fluid_moved(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s)
    {
      constexpr double reach_there = 1.25, viscous_lengths = 1.7, power = 1.6, closed_factor = 2.2; // body lengths
      const double     viscous_length =
          std::sqrt(viscosity_Pa_s / (std::numbers::pi * scene.fluid->density_kg_m3 * frequency_Hz));
      const double reach = std::min(fluid_reach_m(scene), viscous_lengths * viscous_length) / scene.body_length_m();
      return (scene.domain->has_traction_free_wall() ? 1. : closed_factor) *
             std::max(1., std::pow(reach / reach_there, power));
    }
  } // namespace

  InertiaShares inertia_shares(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s,
                               const double young_modulus_Pa)
  {
    if (!scene.fluid)
      return {};
    if (scene.dimension == 3) // not measured yet: all is kept, but where the fluid follows at once
    {
      constexpr double at_once = 1e-3;
      const double     share   = unsteady_group(scene, frequency_Hz, viscosity_Pa_s) > at_once ? 1. : 0.;
      return {share, scene.tail ? share : 0., scene.head.is_free() ? share : 0.};
    }
    // Net displacement without inertia comes from the tail's compliance, with it also from inertia: the ratio of both
    // is that of the unsteady group to the inverse of the elastic one; a tail so soft that it gives all it can leaves
    // the unsteady group alone. Factors: the reference swimmer from 0.1 to 3 Hz, at 1.52 and 0.15 Pa s, from 20 kPa to
    // 1 MPa (docs/study.md), and mass of head and tail as shares of rho_f L^2 there.
    constexpr double stiff_factor = 0.01, soft_factor = 0.044;
    constexpr double head_mass_there = 0.065, tail_mass_there = 0.103;
    const double     L        = scene.body_length_m();
    const double     unsteady = unsteady_group(scene, frequency_Hz, viscosity_Pa_s);
    const double     mass     = scene.fluid->density_kg_m3 * L * L;
    const double     head     = scene.head.density_kg_m3 * scene.head.area_m2() / mass / head_mass_there;
    const double     tail =
        scene.tail ? scene.tail->density_kg_m3 * tail_area_m2(*scene.tail) / mass / tail_mass_there : 0.;
    if (!scene.tail || !scene.tail->is_elastic())
      return {1., tail > 0. ? 1. : 0., scene.head.is_free() ? 1. : 0.}; // nothing else gets a rigid body anywhere
    const double stiff = stiff_factor * unsteady * (1. + unsteady) *
                         elastic_group(scene, frequency_Hz, viscosity_Pa_s, young_modulus_Pa);
    const double soft  = soft_factor * unsteady;
    const double moved = fluid_moved(scene, frequency_Hz, viscosity_Pa_s);
    return {share_of_odds(moved * (.4 * stiff + .6 * soft)), share_of_odds((.2 * stiff + .2 * soft) * tail),
            scene.head.is_free() ? share_of_odds((.6 * stiff + .35 * soft) * head) : 0.};
  }

  InertiaShares inertia_shares(const Scene &scene)
  {
    if (!scene.fluid || scene.time.period_s <= 0.)
      return {};
    InertiaShares shares = inertia_shares(scene, 1. / scene.time.period_s, scene.fluid->viscosity_Pa_s,
                                          scene.tail ? scene.tail->young_modulus_Pa : 0.);
    // A stream past the body, or a motion that is given: its forces change by some hundredths of its Reynolds number.
    constexpr double by_reynolds_number = 0.05;
    const double     speed              = largest_imposed_speed_m_s(scene);
    const double     reynolds_number =
        scene.fluid->density_kg_m3 * speed * scene.body_length_m() / scene.fluid->viscosity_Pa_s;
    shares.fluid = std::max(shares.fluid, share_of_odds(by_reynolds_number * reynolds_number));
    return shares;
  }

  double neglected_share(const Scene &scene)
  {
    if (!scene.fluid || scene.fluid->inertia != Inertia::automatic)
      return 0.;
    const InertiaTerms terms  = inertia_terms(scene);
    InertiaShares      shares = inertia_shares(scene);
    if (terms.of_fluid())
      shares.fluid = 0.;
    if (terms.tail)
      shares.tail = 0.;
    if (terms.head)
      shares.head = 0.;
    return shares.together();
  }
} // namespace swimtwin
