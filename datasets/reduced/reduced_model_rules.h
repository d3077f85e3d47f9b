// What makes a reduced model usable: sizes that fit together, finite numbers, factors that can be inverted.
#pragma once

#include <datasets/reduced/reduced_model.h>

#include <string>

namespace swimtwin
{
  struct ModelProblem
  {
    std::string path;     ///< of the dataset or group in the file
    std::string sentence; ///< "has 3 x 4 values; 4 x 4 are needed."
  };

  /// The first problem found, or one with an empty path.
  ModelProblem find_problem(const ReducedModel &model);
} // namespace swimtwin
