#include <control/field/steering_limits.h>
#include <control/goal/goal_entries.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double default_bound_T = 5e-3 * std::numbers::sqrt2; // of the reference study's coils

    /// Whether a disc of this radius about a point stays in the domain.
    bool is_inside(const Domain &domain, const Eigen::Vector2d &point, const double margin)
    {
      const Eigen::Vector2d p = point - Eigen::Vector2d(domain.center_m[0], domain.center_m[1]);
      if (domain.shape == DomainShape::disc || domain.shape == DomainShape::annulus)
        return p.norm() + margin <= domain.radius_m &&
               (domain.shape == DomainShape::disc || p.norm() - margin >= domain.inner_radius_m);
      return std::abs(p.x()) + margin <= 0.5 * domain.size_m[0] && std::abs(p.y()) + margin <= 0.5 * domain.size_m[1];
    }
  } // namespace

  void read_swimmer(const TomlDocument &document, const std::string &name, SwimmerParameters &values)
  {
    TomlTable table(document, name);
    table.number("young_modulus_Pa", {"Pa", positive}, values.young_modulus_Pa);
    table.number("viscosity_Pa_s", {"Pa s", positive}, values.viscosity_Pa_s);
    table.number("magnetization_A_m", {"A/m", any_number}, values.magnetization_A_m);
    table.finish();
  }

  Drive read_carrier(const TomlDocument &document, const Scene &scene, double *bound_T)
  {
    const bool            is_sinusoid = scene.field.waveform() == FieldProgram::Waveform::sinusoidal;
    const Need            need        = is_sinusoid ? Need::optional : Need::required;
    std::optional<double> bx, by, frequency, bound;
    TomlTable             table(document, "carrier");
    table.number("bx_T", {"T", any_number, need}, bx);
    table.number("by_T", {"T", any_number, need}, by);
    table.number("frequency_Hz", {"Hz", positive, need}, frequency);
    table.number("largest_field_T", {"T", positive}, bound);
    table.finish();
    const double x = bx.value_or(scene.field.bx_T()), y = by.value_or(scene.field.by_T());
    const double limit = bound.value_or(default_bound_T), size = std::hypot(x, y);
    if (size > limit * (1. + 1e-9))
      document.refuse("carrier", "by_T",
                      fmt::format("makes a field of up to {:.4g} T with bx_T = {:.4g}, above largest_field_T = {:.4g}; "
                                  "lower one of them (turning the field keeps its size).",
                                  size, x, limit));
    if (bound_T != nullptr)
      *bound_T = limit;
    return make_drive(FieldProgram::sinusoidal(x, y, frequency.value_or(1. / scene.field.period_s())));
  }

  void read_field_limits(TomlTable &table, FieldLimits &limits)
  {
    table.number("magnitude_T", {"T", positive}, limits.magnitude_T);
    table.number("bx_T", {"T", positive}, limits.component_T[0]);
    table.number("by_T", {"T", positive}, limits.component_T[1]);
    table.number("slew_rate_T_s", {"T/s", positive}, limits.slew_rate_T_s);
    std::vector<std::array<double, 2>> rows;
    for (std::string key = "coil_1_A_T"; table.has(key); key = fmt::format("coil_{}_A_T", rows.size() + 1))
      table.pair(key, {"A/T", any_number}, rows.emplace_back());
    limits.current_per_field_A_T.resize(static_cast<Eigen::Index>(rows.size()), 2);
    for (std::size_t i = 0; i < rows.size(); ++i)
      limits.current_per_field_A_T.row(static_cast<Eigen::Index>(i)) << rows[i][0], rows[i][1];
    table.number("coil_current_A", {"A", positive}, limits.current_A);
  }

  FieldLimits read_limits_of_turned_field(const TomlDocument &document, const Drive &carrier)
  {
    FieldLimits limits;
    TomlTable   table(document, "limits");
    read_field_limits(table, limits);
    table.finish();
    if (const auto broken = limit_broken_when_turned(carrier, limits))
      document.refuse("limits", broken->key, broken->problem);
    return limits;
  }

  double head_margin_m(const Scene &scene)
  {
    return 0.5 * std::hypot(scene.head.size_m[0], scene.head.size_m[1]);
  }

  bool head_is_inside(const Scene &scene, const Eigen::Vector2d &center_m)
  {
    return !scene.domain || scene.domain->moves_with_swimmer ||
           is_inside(*scene.domain, center_m, head_margin_m(scene));
  }
} // namespace swimtwin
