// Whether this build has the full-order model: the online build has not.
#pragma once

#include <string>

namespace swimtwin
{
  /// Throws InputError that names the option which needs it, in a build without.
  void require_full_order_model(const std::string &option);
} // namespace swimtwin
