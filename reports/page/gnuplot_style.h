// The look that all pictures share: a gnuplot script loaded ahead of theirs.
#pragma once

#include <string_view>

namespace swimtwin::gnuplot_scripts
{
  extern const std::string_view style; ///< terminal, colours, grid, heading
} // namespace swimtwin::gnuplot_scripts
