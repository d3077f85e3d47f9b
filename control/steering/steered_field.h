// A periodic field whose direction is steered: swimmers turn with it.
#pragma once

#include <rom/swimmer/driving_field.h>

namespace swimtwin
{
  /// The largest |B| of a periodic drive, T.
  double largest_T(const Drive &drive);

  /// The angles of a swim: coefficients (rad) of a cubic B-spline on uniform knots, the first at the start of the swim.
  struct SteeringPlan
  {
    Drive           carrier;            ///< periodic; of what is steered
    double          knot_periods = 0.5; ///< between two knots
    Eigen::VectorXd angles_rad;         ///< coefficient k acts between the knots k - 3 and k + 1
    /// Felt beside what is played, and not turned.
    Eigen::Vector2d background_T = Eigen::Vector2d::Zero();

    /// Coefficients that act between two instants, in carrier periods since the start: the first, and how many.
    Eigen::Index    first_coefficient(double start) const;
    Eigen::Index    n_coefficients(double start, double end) const;
    double          angle_rad(double periods) const;
    double          angle_rate(double periods) const; ///< rad per period
    Eigen::Vector2d field_T(double periods) const;    ///< as played
    double          largest_field_T() const;          ///< of the carrier: turning keeps it
  };

  /// B(phase) = R(angle(t)) carrier(t) + background, t = start + length phase in periods of the carrier: a window of a
  /// swim, played once. Parameters angle_0_rad, ...: the plan's coefficients that act in it.
  class SteeredField : public DrivingField
  {
  public:
    SteeredField(const SteeringPlan &plan, double start, double length);

    std::vector<std::string> parameter_names() const override;
    Eigen::Vector2d          value_T(double phase, const Eigen::VectorXd &parameters) const override;
    Eigen::Matrix2Xd         slopes(double phase, const Eigen::VectorXd &parameters) const override;
    std::vector<double>      kinks() const override;

  private:
    Drive           carrier_;
    Eigen::Vector2d background_T_;
    double          knot_periods_, start_, length_;
    Eigen::Index    first_, n_;
  };

  /// The plan between two instants (carrier periods): one period of the drive is the whole window.
  Drive window_of(const SteeringPlan &plan, double start, double length);
} // namespace swimtwin
