// The look of a fit's pictures: gnuplot scripts, as in reports/run/run_scripts.h.
#pragma once

#include <string_view>

namespace swimtwin::calibration_scripts
{
  extern const std::string_view fit;             ///< data, curve and bands against frequency; residuals below
  extern const std::string_view profiles;        ///< misfit along each parameter, all others fitted
  extern const std::string_view waterfall;       ///< where the starts ended
  extern const std::string_view pairs;           ///< bootstrap estimates, two by two
  extern const std::string_view next_experiment; ///< what one more observation would bring, against its frequency
} // namespace swimtwin::calibration_scripts
