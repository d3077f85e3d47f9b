// Displacement against frequency, one curve per stiffness and magnetization.
#pragma once

#include <app/frequency_curves.h>
#include <app/gnuplot.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// `sweep` is its name in the caption; at least one curve.
  GnuplotPicture frequency_picture(const std::vector<FrequencyCurve> &curves, const std::string &sweep);
} // namespace swimtwin
