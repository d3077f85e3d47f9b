#include <datasets/scene/surface_units.h>
#include <datasets/text/toml_document.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    struct UsualUnit
    {
      const char *name, *in_m;
      double      length_m;
    };
    constexpr UsualUnit usual_units[] = {{"mm", "1e-3", 1e-3}, {"um", "1e-6", 1e-6}, {"m", "1.0", 1.}};

    double longest_side_m(const Domain &domain)
    {
      return std::max({domain.size_m[0], domain.size_m[1], domain.size_z_m, 2. * domain.radius_m});
    }

    double length_of_swimmer_m(const Scene &scene)
    {
      return scene.head.surface ? extent(scene.head.surface->nodes).size().maxCoeff() : scene.body_length_m();
    }

    /// Lengths of domain and swimmer.
    bool go_together(const double domain_m, const double swimmer_m)
    {
      return domain_m >= swimmer_m && domain_m <= 300. * swimmer_m;
    }
  } // namespace

  void check_surface_units(const TomlDocument &document, const Scene &scene)
  {
    const bool is_of_walls = scene.domain->surface != nullptr;
    if (!is_of_walls && !scene.head.surface)
      return;
    const double domain_m = longest_side_m(*scene.domain), swimmer_m = length_of_swimmer_m(scene);
    if (go_together(domain_m, swimmer_m))
      return;
    const std::string table  = is_of_walls ? "domain" : "head";
    const toml::node *entry  = document.find(table + ".surface_unit_m");
    const double      unit_m = entry->value_or(1.);
    for (const auto &[name, in_m, length_m] : usual_units)
      if (const double larger = length_m / unit_m;
          is_of_walls ? go_together(larger * domain_m, swimmer_m) : go_together(domain_m, larger * swimmer_m))
        document.refuse(table, "surface_unit_m",
                        fmt::format("m makes the domain {:.3g} m long, but the swimmer {:.3g} m; if the file is in {}, "
                                    "as it seems, set it to {}, else change the sizes.",
                                    domain_m, swimmer_m, name, in_m));
  }
} // namespace swimtwin
