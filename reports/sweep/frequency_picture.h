// Displacement against frequency, one curve per stiffness and magnetization.
#pragma once

#include <reports/page/gnuplot.h>
#include <reports/sweep/frequency_curves.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Points from elsewhere, drawn over the curves of the same names.
  struct FrequencyMarks
  {
    std::string                 name;
    std::vector<FrequencyCurve> curves;
  };

  /// `sweep` is its name in the caption; at least one curve.
  GnuplotPicture frequency_picture(const std::vector<FrequencyCurve> &curves, const std::string &sweep,
                                   const FrequencyMarks &marks = {});
} // namespace swimtwin
