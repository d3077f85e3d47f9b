// Between the free parameters of a fit and the swimmer that they describe.
#pragma once

#include <calibration/misfit/motion_groups.h>
#include <datasets/observation/calibration_problem.h>

namespace swimtwin
{
  /// What a recorded displacement depends on: logarithms of the first six, the offset itself (m).
  enum RecordingQuantity {
    by_geometry_scale = n_motion_quantities,
    by_displacement_scale,
    by_displacement_offset,
    n_recording_quantities
  };

  /// Free parameters as a vector x of scaled variables: logarithms, or values over a unit of their size. The noise
  /// level is not among them: it follows from the residuals.
  class ParameterMap
  {
  public:
    /// Values that the problem does not name are those of `nominal`. `displacement_m` is the size of an offset.
    ParameterMap(const CalibrationProblem &problem, const CalibratedSwimmer &nominal, double displacement_m);

    int                               size() const { return static_cast<int>(free_.size()); }
    const std::vector<FreeParameter> &free() const { return free_; }
    std::vector<std::string>          names() const;

    CalibratedSwimmer swimmer(const Eigen::VectorXd &x) const;
    /// Derivatives of the recording's quantities by x, n_recording_quantities x size().
    Eigen::MatrixXd slopes(const Eigen::VectorXd &x) const;

    double          value(int parameter, double x) const;
    double          scaled(int parameter, double value) const;
    double          value_slope(int parameter, double x) const; ///< of value by x
    Eigen::VectorXd values(const Eigen::VectorXd &x) const;
    Eigen::VectorXd lower() const, upper() const;
    /// The nominal swimmer, moved into the bounds.
    Eigen::VectorXd nominal() const;
    /// Whether a motion's derivative by this quantity is needed.
    std::array<bool, n_motion_quantities> needed() const;

    /// Smallest box that holds the groups of all swimmers within the bounds [lower, upper] of x.
    GroupBox group_box(const MotionGroups &groups, const Eigen::VectorXd &lower, const Eigen::VectorXd &upper) const;

    /// Prior of a parameter in its scaled variable; the standard deviation is infinite without one.
    double prior_mean(int parameter) const;
    double prior_standard_deviation(int parameter) const;
    bool   has_prior(const int parameter) const { return free_[static_cast<std::size_t>(parameter)].prior.has_value(); }

  private:
    double unit(int parameter) const { return units_[static_cast<std::size_t>(parameter)]; }
    bool   is_free(FittedQuantity quantity) const;

    std::vector<FreeParameter> free_;
    std::vector<double>        units_;
    CalibratedSwimmer          nominal_;
    /// Given, not free: what follows the viscosity.
    std::optional<double> young_modulus_over_viscosity_, magnetization_over_viscosity_;
  };

  /// The scene's swimmer with the values that the problem gives.
  CalibratedSwimmer nominal_swimmer(const CalibrationProblem &problem, const CalibratedSwimmer &scene);
  /// A quantity of a swimmer: one of its members or ratios.
  double value_of(FittedQuantity quantity, const CalibratedSwimmer &swimmer);
} // namespace swimtwin
