// The look of a sweep's picture, as in reports/run/run_scripts.h.
#pragma once

#include <string_view>

namespace swimtwin::gnuplot_scripts
{
  extern const std::string_view displacement_frequency; ///< curves of a sweep
} // namespace swimtwin::gnuplot_scripts
