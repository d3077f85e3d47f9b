// What a periodic motion is worth and what it costs: the terms of an objective.
#pragma once

#include <control/field/field_variables.h>
#include <control/stroke/stroke.h>

#include <array>
#include <string>
#include <string_view>

namespace swimtwin
{
  enum class StrokeTerm {
    mean_speed,        ///< m/s along the direction of travel; more is better
    displacement,      ///< m per period, likewise
    efficiency,        ///< viscosity x speed^2 / mean magnetic power; more is better
    mean_square_field, ///< T^2, the coils' mean loss; less is better
    copper_loss,       ///< T^2 s, integral of |B|^2 over a period; less is better
    magnetic_work      ///< J/m, of the field on the swimmer per period; less is better
  };

  inline constexpr std::array all_stroke_terms = {StrokeTerm::mean_speed,  StrokeTerm::displacement,
                                                  StrokeTerm::efficiency,  StrokeTerm::mean_square_field,
                                                  StrokeTerm::copper_loss, StrokeTerm::magnetic_work};
  /// "mean_speed", ...
  std::string to_string(StrokeTerm term);
  /// "m/s", ...
  std::string_view unit(StrokeTerm term);
  bool             is_gain(StrokeTerm term);

  /// Slopes by all coefficients of the field and the frequency, if the stroke has them.
  struct TermValue
  {
    double             value = 0.;
    Eigen::RowVectorXd slopes;
  };

  /// Of a stroke in a Fourier field, for a swimmer whose head points along -(cos heading, sin heading).
  TermValue evaluate(StrokeTerm term, const ReducedSwimmer &swimmer, const FourierField &field, const Stroke &stroke,
                     double heading_rad);
} // namespace swimtwin
