// The look of a plan's pictures and of what was made of it, as in reports/run/run_scripts.h.
#pragma once

#include <string_view>

namespace swimtwin::gnuplot_scripts
{
  extern const std::string_view planned_field; ///< components over a period
  extern const std::string_view hodograph;     ///< by against bx
  extern const std::string_view head_path;     ///< in several fields
  extern const std::string_view gains;         ///< mean speeds as bars
  extern const std::string_view trade_off;     ///< speed and gain against the multiplier allowed
  extern const std::string_view search_trace;  ///< objective and violation by cost
  extern const std::string_view led_course;    ///< along a path: distance, field and time of decisions
} // namespace swimtwin::gnuplot_scripts
