// The groups that a motion depends on: logarithms of E/mu, M b/mu and, with a magnetised tail, b/mu, where b scales the
// field, and of mu itself where there is inertia (docs/equations.md, section 16).
#pragma once

#include <calibration/misfit/exact_displacements.h>

namespace swimtwin
{
  /// A region of the groups; of no width where a group does not change.
  struct GroupBox
  {
    Eigen::VectorXd lower, upper;
  };

  class MotionGroups
  {
  public:
    explicit MotionGroups(const CalibrationModel &model);

    int             size() const { return static_cast<int>(slopes_.rows()); }
    Eigen::VectorXd values(const CalibratedSwimmer &swimmer) const;
    /// Derivatives by the logarithms of MotionQuantity, size() x 4.
    const Eigen::MatrixXd &slopes() const { return slopes_; }
    /// A swimmer with these groups, without inertia at the scene's viscosity.
    CalibratedSwimmer swimmer(const Eigen::VectorXd &groups) const;

  private:
    CalibratedSwimmer nominal_;
    bool              has_magnetic_tail_, has_inertia_;
    Eigen::MatrixXd   slopes_;
  };
} // namespace swimtwin
