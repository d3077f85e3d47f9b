// How much a residual counts.
#pragma once

#include <datasets/observation/calibration_problem.h>

namespace swimtwin
{
  /// rho(r), r in sigma: half the square for small residuals, less for large ones. With width w:
  ///   least squares  r^2 / 2
  ///   Huber          r^2 / 2 up to w, then w |r| - w^2 / 2
  ///   pseudo-Huber   w^2 (sqrt(1 + (r/w)^2) - 1)
  ///   Cauchy         w^2 / 2 log(1 + (r/w)^2)
  class RobustLoss
  {
  public:
    explicit RobustLoss(const LossKind kind = LossKind::least_squares, const double width = 1.345)
        : kind_(kind), width_(width)
    {
    }

    double value(double residual) const;
    double slope(double residual) const; ///< d rho / dr
    /// slope / residual: 1 for least squares.
    double weight(double residual) const;
    /// sign(r) sqrt(2 rho), the number whose half square is rho, and its derivative.
    double root(double residual) const;
    double root_slope(double residual) const;

    bool is_robust() const { return kind_ != LossKind::least_squares; }

  private:
    LossKind kind_;
    double   width_;
  };
} // namespace swimtwin
