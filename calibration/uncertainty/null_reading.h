// What a null direction means to the person who fits.
#pragma once

#include <calibration/fit/fit.h>

#include <datasets/observation/calibration_result.h>

namespace swimtwin
{
  /// The null directions of an estimate, each with its reading. Where the known ones (E, mu and M together; field scale
  /// against M; geometry scale against displacement scale; viscosity at fixed ratios) lie in the null space they are
  /// its basis, as far as they go.
  std::vector<NullDirection> null_directions(const FitInput &input, const Estimate &estimate);
} // namespace swimtwin
