// What a reduced model says about itself, for people.
#pragma once

#include <datasets/reduced/reduced_model.h>

#include <string>

namespace swimtwin
{
  /// Where it was trained, how far off it was on held-out runs, what it neglects; several lines.
  std::string model_card(const ReducedModel &model);
} // namespace swimtwin
