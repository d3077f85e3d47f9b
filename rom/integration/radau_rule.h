// The three-stage Radau IIA rule: collocation of order 5, stable however stiff, its last stage is the step's end.
#pragma once

#include <Eigen/Dense>

#include <cmath>

namespace swimtwin
{
  struct RadauRule
  {
    static constexpr int n_stages = 3;
    /// Stage i at the fraction c_i of a step: y_i = y_0 + h sum_j A_ij y'_j. The last row is that of the integral.
    Eigen::Matrix3d A;
    Eigen::Vector3d c;
  };

  /// E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, table IV.5.6.
  inline RadauRule radau_rule()
  {
    const double s = std::sqrt(6.);
    RadauRule    rule;
    rule.A << (88. - 7. * s) / 360., (296. - 169. * s) / 1800., (-2. + 3. * s) / 225., (296. + 169. * s) / 1800.,
        (88. + 7. * s) / 360., (-2. - 3. * s) / 225., (16. - s) / 36., (16. + s) / 36., 1. / 9.;
    rule.c << (4. - s) / 10., (4. + s) / 10., 1.;
    return rule;
  }
} // namespace swimtwin
