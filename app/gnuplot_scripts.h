// The look of the pictures: gnuplot scripts whose numbers come from variables set before them.
#pragma once

#include <string_view>

namespace swimtwin::gnuplot_scripts
{
  extern const std::string_view style;                  ///< terminal, colours, grid, heading
  extern const std::string_view trajectory;             ///< path of the head, displacement over time
  extern const std::string_view angles;                 ///< head, tail and field over time
  extern const std::string_view stroke_loop;            ///< tail angle against head angle
  extern const std::string_view power_balance;          ///< powers and their residual over time
  extern const std::string_view shapes;                 ///< outlines at some instants
  extern const std::string_view displacement_frequency; ///< curves of a sweep
  extern const std::string_view planned_field;          ///< components over a period
  extern const std::string_view hodograph;              ///< by against bx
  extern const std::string_view head_path;              ///< in several fields
  extern const std::string_view gains;                  ///< mean speeds as bars
  extern const std::string_view trade_off;              ///< speed and gain against the multiplier allowed
  extern const std::string_view search_trace;           ///< objective and violation by cost
} // namespace swimtwin::gnuplot_scripts
