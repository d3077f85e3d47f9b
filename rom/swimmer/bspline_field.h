// A field whose components are cubic B-splines of phase.
#pragma once

#include <rom/swimmer/driving_field.h>
#include <rom/swimmer/uniform_spline.h>

namespace swimtwin
{
  /// Parameters bx_0_T, by_0_T, bx_1_T, ...: coefficients of the splines, which bound the field (it is a mean of four
  /// of them). A periodic one repeats with phase; another one is played once, for phases from 0 to 1, and then keeps
  /// its last value: a horizon of n periods of a sinusoid is one period of a drive with an n-th of its frequency.
  class BSplineField : public DrivingField
  {
  public:
    explicit BSplineField(const UniformSpline &spline) : spline_(spline) {}

    const UniformSpline &spline() const { return spline_; }

    std::vector<std::string> parameter_names() const override;
    Eigen::Vector2d          value_T(double phase, const Eigen::VectorXd &parameters) const override;
    Eigen::Matrix2Xd         slopes(double phase, const Eigen::VectorXd &parameters) const override;
    void                     pull_back(double phase, const Eigen::VectorXd &parameters, const Eigen::Vector2d &by_field,
                                       Eigen::Ref<Eigen::VectorXd> by_parameters) const override;
    /// dB/dphase (T).
    Eigen::Vector2d rate_T(double phase, const Eigen::VectorXd &parameters) const;

  private:
    UniformSpline spline_;
  };

  /// The spline drive closest to samples of another drive over `n_periods` of its periods: as many equal intervals,
  /// 4 samples each.
  Drive spline_drive(const Drive &drive, int n_intervals, bool is_periodic, int n_periods = 1);
} // namespace swimtwin
