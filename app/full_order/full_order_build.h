// Whether this program has the full-order model: the online build has not, and the tool leaves it to a program of its
// own.
#pragma once

#include <app/frame/library_environment.h>

#include <string>

namespace swimtwin
{
  /// Throws InputError that names the option which needs it, in a build without. In the tool it does not return: the
  /// program that has the model goes on with the same command line, on these ranks.
  void require_full_order_model(const std::string &option, RanksAtWork ranks);
} // namespace swimtwin
