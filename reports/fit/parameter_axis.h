// The axis of a parameter in a picture.
#pragma once

#include <reports/fit/fitted_quantity.h>
#include <reports/page/gnuplot.h>

namespace swimtwin
{
  struct Span
  {
    double low = 0., high = 0.;

    void include(double value); ///< unless it is not finite
  };

  /// With a margin on both sides, as part of the width; some width around a single value.
  Span widened(const Span &span, double part);

  /// Variables name_k, low_k, high_k, step_k (at most `n_ticks` steps in the span) and logarithmic_k (for more than a
  /// decade) of a script.
  void set_parameter_axis(GnuplotPicture &picture, std::size_t k, const ShownQuantity &shown, const Span &span,
                          double n_ticks);
} // namespace swimtwin
