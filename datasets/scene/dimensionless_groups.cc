#include <datasets/scene/dimensionless_groups.h>

#include <datasets/scene/inertia_terms.h>
#include <datasets/surface/closed_surface.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    double mean_height_m(const Tail &tail)
    {
      return tail.mean_height_m();
    }
  } // namespace

  double unsteady_group(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s)
  {
    const double L = scene.body_length_m();
    return 2. * std::numbers::pi * scene.fluid->density_kg_m3 * frequency_Hz * L * L / viscosity_Pa_s;
  }

  double unsteady_group(const Scene &scene)
  {
    if (!scene.fluid || scene.time.period_s <= 0.)
      return 0.;
    return unsteady_group(scene, 1. / scene.time.period_s, scene.fluid->viscosity_Pa_s);
  }

  double fluid_reach_m(const Scene &scene)
  {
    const Domain &domain = *scene.domain;
    if (domain.surface)
      return .5 * extent(domain.surface->nodes).size().head<2>().minCoeff();
    return domain.radius_m > 0. ? domain.radius_m : .5 * std::min(domain.size_m[0], domain.size_m[1]);
  }

  double unsteady_group_of_domain(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s)
  {
    const double in_lengths = fluid_reach_m(scene) / scene.body_length_m();
    const double reach      = scene.dimension == 3 ? std::min(1., in_lengths) : in_lengths;
    return reach * reach * unsteady_group(scene, frequency_Hz, viscosity_Pa_s);
  }

  double largest_imposed_speed_m_s(const Scene &scene)
  {
    constexpr double two_pi  = 2. * std::numbers::pi;
    double           largest = 0.;
    if (scene.domain)
      for (const auto &[name, wall] : scene.domain->walls)
      {
        const bool is_parabolic = wall.condition == WallCondition::inflow && wall.profile == InflowProfile::parabolic;
        largest                 = std::max(largest, std::abs(wall.speed_m_s) * (is_parabolic ? 1.5 : 1.));
        const double height     = scene.domain->radius_m > 0. ? scene.domain->radius_m : .5 * scene.domain->size_m[1];
        largest                 = std::max(largest, std::abs(wall.shear_rate_1_s) * height);
      }
    if (const HeadOscillation &given = scene.head.oscillation; scene.head.is_driven())
      largest = std::max(largest, two_pi * given.frequency_Hz *
                                      (std::hypot(given.amplitude_m[0], given.amplitude_m[1]) +
                                       std::abs(given.angle_rad) * scene.body_length_m()));
    if (scene.tail && scene.tail->is_driven()) // of the tip, were it to turn as a whole
      largest = std::max(largest, two_pi * scene.tail->wave.frequency_Hz * std::abs(scene.tail->wave.angle_rad) *
                                      scene.tail->length_m / 2.);
    return largest;
  }

  std::string share_of_displacement(const double share)
  {
    const double percent = 100. * share;
    return fmt::format("an estimated {} % of the displacement",
                       percent < 10. ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent));
  }

  std::string inertia_warning(const Scene &scene)
  {
    const double share = neglected_share(scene);
    if (share <= negligible_share)
      return {};
    return fmt::format(
        "inertia is left out, and with it {}; use [numerics] coupling = \"monolithic\" to keep it, or set [fluid] "
        "inertia = \"none\" to neglect it knowingly",
        share_of_displacement(share));
  }

  double magnetic_group(const Scene &scene)
  {
    if (!scene.fluid || scene.time.period_s <= 0.)
      return 0.;
    const auto   field = scene.field(0.25 * scene.time.period_s);
    const double L     = scene.body_length_m();
    return scene.head.magnetization_A_m * scene.head.volume(scene.dimension) *
           std::hypot(field[0], field[1], field[2]) * scene.time.period_s /
           (scene.fluid->viscosity_Pa_s * std::pow(L, scene.dimension));
  }

  MagneticSwing magnetic_swing(const Scene &scene)
  {
    if (!scene.fluid || scene.time.period_s <= 0.)
      return {};
    if (scene.dimension == 3)
      return {}; // not estimated
    const double pi = std::numbers::pi, L = scene.body_length_m(), group = magnetic_group(scene);
    const double mass =
        scene.head.density_kg_m3 * scene.head.area_m2() +
        (scene.tail ? scene.tail->density_kg_m3 * scene.tail->length_m * mean_height_m(*scene.tail) : 0.);
    const double inertia = mass * L * L / 12. + pi * scene.fluid->density_kg_m3 * std::pow(L, 4) / 128.;
    const double torque  = std::abs(group) * scene.fluid->viscosity_Pa_s * L * L / scene.time.period_s;
    const double rate    = std::sqrt(torque / inertia);
    return {rate, rate > 0. ? .5 * pi * scene.fluid->viscosity_Pa_s * L * L / (2. * inertia * rate) : 0.};
  }

  double elastic_group(const Scene &scene, const double frequency_Hz, const double viscosity_Pa_s,
                       const double young_modulus_Pa)
  {
    const Tail  &tail = *scene.tail;
    const double h    = mean_height_m(tail);
    if (scene.dimension == 3 && tail.section == TailSection::rectangular)
      return young_modulus_Pa * tail.width_m * std::pow(h, 3) /
             (12. * std::numbers::pi * viscosity_Pa_s * frequency_Hz * std::pow(tail.length_m, 4));
    if (scene.dimension == 3)
      return young_modulus_Pa * std::pow(h / tail.length_m, 4) / (64. * viscosity_Pa_s * frequency_Hz);
    return young_modulus_Pa * std::pow(h / tail.length_m, 3) /
           (12. * (1. - tail.poisson_ratio * tail.poisson_ratio) * viscosity_Pa_s * frequency_Hz);
  }

  double elastic_group(const Scene &scene)
  {
    if (!scene.fluid || !scene.tail || scene.time.period_s <= 0.)
      return 0.;
    return elastic_group(scene, 1. / scene.time.period_s, scene.fluid->viscosity_Pa_s, scene.tail->young_modulus_Pa);
  }
} // namespace swimtwin
