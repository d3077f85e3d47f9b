// How a model that was refined at its own results came to agree with the full-order model.
#pragma once

#include <concepts>
#include <string>
#include <type_traits>

namespace swimtwin
{
  struct RefinementRound
  {
    std::string model_file;
    double      difference = 0.; ///< of both models at the result, relative to the full-order one; the largest
  };

  template <typename Type, typename Visitor>
  requires std::same_as<std::remove_const_t<Type>, RefinementRound>
  void for_each_entry(Type &v, const Visitor &visit) // see datasets/files/json_entries.h
  {
    visit("model_file", v.model_file);
    visit("difference", v.difference);
  }
} // namespace swimtwin
