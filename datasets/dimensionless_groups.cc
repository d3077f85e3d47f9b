#include <datasets/dimensionless_groups.h>

#include <datasets/inertia_terms.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
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

  std::string inertia_warning(const Scene &scene)
  {
    const double group = unsteady_group(scene);
    if (group <= 1. || scene.fluid->inertia != Inertia::automatic || inertia_terms(scene).of_fluid())
      return {};
    return fmt::format(
        "the unsteady group is {:.3g}: fluid inertia is not small, and this run neglects it; set [fluid] "
        "inertia = \"full\" to keep it, or \"none\" to neglect it knowingly",
        group);
  }

  double magnetic_group(const Scene &scene)
  {
    if (!scene.fluid || scene.time.period_s <= 0.)
      return 0.;
    const auto   field = scene.field(0.25 * scene.time.period_s);
    const double L     = scene.body_length_m();
    return scene.head.magnetization_A_m * scene.head.area_m2() * std::hypot(field[0], field[1]) * scene.time.period_s /
           (scene.fluid->viscosity_Pa_s * L * L);
  }

  double elastic_group(const Scene &scene)
  {
    if (!scene.fluid || !scene.tail || scene.time.period_s <= 0.)
      return 0.;
    const Tail  &tail = *scene.tail;
    const double h    = .5 * (tail.root_height_m + tail.tip_height_m);
    return tail.young_modulus_Pa * std::pow(h / tail.length_m, 3) * scene.time.period_s /
           (12. * (1. - tail.poisson_ratio * tail.poisson_ratio) * scene.fluid->viscosity_Pa_s);
  }
} // namespace swimtwin
