// A row of a table that cannot be used, though others can.
#pragma once

#include <cstddef>
#include <string>

namespace swimtwin
{
  struct WrongRow
  {
    std::size_t line = 0; ///< in its file
    std::string text;     ///< `file:line: what is wrong; remedy.`
  };
} // namespace swimtwin
