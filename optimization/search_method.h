// The algorithms of NLopt that we offer, and what each of them can do.
#pragma once

#include <string>
#include <vector>

namespace swimtwin
{
  enum class SearchMethod {
    mma,         ///< with gradients and constraints
    ccsaq,       ///< likewise
    slsqp,       ///< likewise
    lbfgs,       ///< with gradients, bounds only
    cobyla,      ///< without gradients, with constraints
    bobyqa,      ///< without gradients, bounds only
    sbplx,       ///< likewise
    nelder_mead, ///< likewise
    isres        ///< global, without gradients, with constraints; needs finite bounds
  };

  std::string to_string(SearchMethod method);
  /// Throws InputError with the methods there are.
  SearchMethod                     search_method(const std::string &name);
  const std::vector<SearchMethod> &all_search_methods();

  bool uses_gradients(SearchMethod method);
  bool takes_constraints(SearchMethod method);
} // namespace swimtwin
