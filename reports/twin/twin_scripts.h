// gnuplot scripts of a twin's pictures.
#pragma once

#include <string_view>

namespace swimtwin::gnuplot_scripts
{
  extern const std::string_view twin_parameters, twin_innovations, twin_swim;
} // namespace swimtwin::gnuplot_scripts
