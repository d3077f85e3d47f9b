#include <datasets/scene/inertia_terms.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/scene_names.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    InertiaTerms chosen_by_share(const Scene &scene, const InertiaShares &shares)
    {
      if (scene.is_partitioned())
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
        return all_inertia;
      case Inertia::chosen:
        return scene.fluid->chosen;
      case Inertia::automatic:
        return chosen_by_share(scene, shares);
      case Inertia::none:
        return {};
      }
      return {};
    }

    /// In the plane the area; in space a round section is taken to have the mean height.
    double tail_volume(const Tail &tail, const int dimension)
    {
      const double h = tail.mean_height_m();
      const double section =
          tail.section == TailSection::rectangular ? h * tail.width_m : std::numbers::pi * h * h / 4.;
      return tail.length_m * (dimension == 2 ? h : section);
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

  std::string inertia_override(const std::vector<std::string> &names)
  {
    return names.empty() ? "fluid.inertia=none" : fmt::format("fluid.inertia=[\"{}\"]", fmt::join(names, "\", \""));
  }

  double InertiaShares::together() const
  {
    const auto odds = [](const double share) { return share < 1. ? share / (1. - share) : 1e300; };
    return share_of_odds(std::min(1e15, odds(fluid) + odds(tail) + odds(head)));
  }

  namespace
  {
    /// How much more fluid there is to be moved than around the reference swimmer in its box: as far as walls, or a
    /// flow that oscillates, let it. Measured in boxes of 20 to 80 mm and discs of 12 to 50 mm (docs/study.md). In
    /// space flows decay within the body's length.
    double fluid_moved(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s)
    {
      if (scene.dimension == 3)
        return 1.;
      constexpr double reach_there = 1.25, viscous_lengths = 1.7, power = 1.6, closed_factor = 2.2; // body lengths
      const double     viscous_length =
          std::sqrt(viscosity_Pa_s / (std::numbers::pi * scene.fluid->density_kg_m3 * frequency_Hz));
      const double reach = std::min(fluid_reach_m(scene), viscous_lengths * viscous_length) / scene.body_length_m();
      return (scene.domain->has_traction_free_wall() ? 1. : closed_factor) *
             std::max(1., std::pow(reach / reach_there, power));
    }

    /// Net displacement without inertia comes from the tail's compliance, with it also from inertia: the ratio of both
    /// is that of the unsteady group to the inverse of the elastic one (`stiff`); a tail so soft that it gives all it
    /// can leaves the unsteady group alone (`soft`). Factors of the reference swimmers (docs/study.md, sections 6 and
    /// 7), and their masses as shares of rho_f L^2, in space L^3.
    struct MeasuredRatio
    {
      double stiff, soft, growth; ///< of `stiff` with the unsteady group
      struct Part
      {
        double of_stiff, of_soft, mass;
      } fluid, tail, head;
    };
    // From 0.1 to 3 Hz, at 1.52 and 0.15 Pa s, from 20 kPa to 1 MPa.
    constexpr MeasuredRatio in_plane{.01, .044, 1., {.4, .6, 1.}, {.2, .2, .103}, {.6, .35, .065}};
    // From 0.2 to 2 Hz, at 1.52 and 0.15 Pa s, from 100 to 800 kPa, 100 and 200 kA/m.
    constexpr MeasuredRatio in_space{.067, .016, 0., {.7, .7, 1.}, {.16, .16, .0086}, {.24, .24, .0096}};
  } // namespace

  InertiaShares inertia_shares(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s,
                               const double young_modulus_Pa)
  {
    if (!scene.fluid)
      return {};
    constexpr double at_once  = 1e-3;
    const double     unsteady = unsteady_group(scene, frequency_Hz, viscosity_Pa_s);
    if (!scene.tail || !scene.tail->is_elastic()) // nothing else gets a rigid body anywhere
    {
      const double share = scene.dimension == 2 || unsteady > at_once ? 1. : 0.;
      return {share, scene.tail ? share : 0., scene.head.is_free() ? share : 0.};
    }
    const MeasuredRatio &measured = scene.dimension == 3 ? in_space : in_plane;
    const double         stiff    = measured.stiff * unsteady * (1. + measured.growth * unsteady) *
                         elastic_group(scene, frequency_Hz, viscosity_Pa_s, young_modulus_Pa);
    const double soft       = measured.soft * unsteady;
    const double fluid_mass = scene.fluid->density_kg_m3 * std::pow(scene.body_length_m(), scene.dimension);
    const auto   share_of   = [&](const MeasuredRatio::Part &part, const double mass) {
      return share_of_odds((part.of_stiff * stiff + part.of_soft * soft) * mass / fluid_mass / part.mass);
    };
    return {share_of(measured.fluid, fluid_mass * fluid_moved(scene, frequency_Hz, viscosity_Pa_s)),
            share_of(measured.tail, scene.tail->density_kg_m3 * tail_volume(*scene.tail, scene.dimension)),
            scene.head.is_free()
                ? share_of(measured.head, scene.head.density_kg_m3 * scene.head.volume(scene.dimension))
                : 0.};
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
    if (terms.tail || scene.time.is_steady)
      shares.tail = 0.;
    if (terms.head || scene.time.is_steady)
      shares.head = 0.;
    return shares.together();
  }
} // namespace swimtwin
