// Derivatives against central differences.
#pragma once

#include <control/stroke/stroke_problem.h>

namespace swimtwin
{
  struct GradientCheck
  {
    std::string name;
    double      size       = 0.; ///< largest derivative by a variable, per scale of the variable
    double      difference = 0.; ///< largest difference of the two, relative to it
  };

  /// Every term, and the largest constraint of every kind, at one field: derivatives by sensitivities against central
  /// differences of fourth order, both at tolerances far below a search's. Throws ComputationError where no periodic
  /// motion is found.
  std::vector<GradientCheck> check_gradients(const ReducedModel &model, const ReducedSwimmer &swimmer,
                                             const SwimmingGoal &goal, const FieldVariables &variables,
                                             const Eigen::VectorXd &x);
} // namespace swimtwin
