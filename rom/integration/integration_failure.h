// Why CVODES gave up, in words.
#pragma once

#include <string>

namespace swimtwin
{
  /// A phrase for one of CVODES' negative return codes.
  std::string integration_failure(int flag, long max_steps);
} // namespace swimtwin
