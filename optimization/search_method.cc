#include <datasets/system/error.h>
#include <optimization/search_method.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace swimtwin
{
  namespace
  {
    using enum SearchMethod;

    std::vector<std::string> all_names()
    {
      std::vector<std::string> names;
      for (const SearchMethod method : all_search_methods())
        names.push_back(to_string(method));
      return names;
    }
  } // namespace

  std::string to_string(const SearchMethod method)
  {
    switch (method)
    {
    case mma:
      return "mma";
    case ccsaq:
      return "ccsaq";
    case slsqp:
      return "slsqp";
    case lbfgs:
      return "lbfgs";
    case cobyla:
      return "cobyla";
    case bobyqa:
      return "bobyqa";
    case sbplx:
      return "sbplx";
    case nelder_mead:
      return "nelder-mead";
    case isres:
      break;
    }
    return "isres";
  }

  SearchMethod search_method(const std::string &name)
  {
    for (const SearchMethod method : all_search_methods())
      if (to_string(method) == name)
        return method;
    throw InputError(fmt::format("There is no search method '{}'; use one of {}.", name, fmt::join(all_names(), ", ")));
  }

  const std::vector<SearchMethod> &all_search_methods()
  {
    static const std::vector<SearchMethod> methods = {mma,    ccsaq, slsqp,       lbfgs, cobyla,
                                                      bobyqa, sbplx, nelder_mead, isres};
    return methods;
  }

  bool uses_gradients(const SearchMethod method)
  {
    return method == mma || method == ccsaq || method == slsqp || method == lbfgs;
  }

  bool takes_constraints(const SearchMethod method)
  {
    return method == mma || method == ccsaq || method == slsqp || method == cobyla || method == isres;
  }
} // namespace swimtwin
