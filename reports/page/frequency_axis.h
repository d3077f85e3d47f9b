// The axis of frequencies in a picture.
#pragma once

#include <reports/page/gnuplot.h>

namespace swimtwin
{
  /// Variables logarithmic, f_min and f_max of a script. More than `logarithmic_above` times the lowest frequency is
  /// shown by its logarithm, with `margin` times as much room at both ends.
  struct FrequencyAxis
  {
    double lowest_Hz = 0., highest_Hz = 0.;
    double logarithmic_above = 10., margin = 1.15;

    void set_in(GnuplotPicture &picture) const;
  };
} // namespace swimtwin
