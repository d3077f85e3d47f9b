// What may be left out of a reduced swimmer's polynomials: each monomial costs time at each step.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/swimmer_parameters.h>

namespace swimtwin
{
  /// Fits so many times worse than the best, in cross-validation, will do.
  inline constexpr double nearly_as_good = 1.15;
  /// Fits so many times worse are no rivals, even if the swimmer's ways should be alike by chance.
  inline constexpr double no_rival = 3.;

  /// Ways of the head (m; along the scene's heading and across) in the third periods from rest of twelve members of the
  /// model's range, a column each; NaN where a run fails.
  Eigen::Matrix2Xd third_ways(const ReducedModel &model, const Scene &scene, const InertialDensities &densities = {});

  /// How far apart ways are: root mean square, relative to the displacements, the second ones' ways along the heading
  /// (of those that hardly get on, to a twentieth of the largest).
  double relative_difference(const Eigen::Matrix2Xd &ways, const Eigen::Matrix2Xd &others);

  /// Whether they differ by so little that it is not felt beside the model's target: by a tenth of it.
  bool are_alike(const Eigen::Matrix2Xd &ways, const Eigen::Matrix2Xd &others, double target);
} // namespace swimtwin
