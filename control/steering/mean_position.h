// Where a swimmer is on average over one period: it swings to and fro by much more than it advances.
#pragma once

#include <Eigen/Dense>

#include <vector>

namespace swimtwin
{
  /// Positions along a swim, by time in periods.
  class MeanPosition
  {
  public:
    /// Later than the last one; the position is linear in between.
    void add(double periods, const Eigen::Vector2d &position_m);

    bool   has_period() const { return !times_.empty() && times_.back() - times_.front() >= 1. - 1e-9; }
    double now() const { return times_.back(); }
    /// Integral over periods since the first position.
    Eigen::Vector2d integral_at(double periods) const;
    /// Mean over the last period before an instant. Earlier than a period after the first: over what there is.
    Eigen::Vector2d mean_at(double periods) const;

  private:
    std::vector<double>          times_;
    std::vector<Eigen::Vector2d> positions_, integrals_;
  };
} // namespace swimtwin
