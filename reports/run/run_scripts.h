// The look of a run's pictures: gnuplot scripts whose numbers come from variables set before them.
#pragma once

#include <string_view>

namespace swimtwin::gnuplot_scripts
{
  extern const std::string_view trajectory;    ///< path of the head, displacement over time
  extern const std::string_view angles;        ///< head, tail and field over time
  extern const std::string_view stroke_loop;   ///< tail angle against head angle
  extern const std::string_view power_balance; ///< powers and their residual over time
  extern const std::string_view shapes;        ///< outlines at some instants
  extern const std::string_view spatial_view;  ///< surfaces in space at four instants
  extern const std::string_view flow_in_plane; ///< speed and direction of the flow at four instants
} // namespace swimtwin::gnuplot_scripts
