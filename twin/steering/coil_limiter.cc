#include <twin/steering/coil_limiter.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  CoilLimiter::CoilLimiter(const FieldLimits &limits) : limits_(limits) {}

  double CoilLimiter::use_of(const Eigen::Vector2d &field_T) const
  {
    double use = std::max({field_T.norm() / limits_.magnitude_T, std::abs(field_T.x()) / limits_.component_T[0],
                           std::abs(field_T.y()) / limits_.component_T[1]});
    if (limits_.current_per_field_A_T.rows() > 0)
      use = std::max(use, (limits_.current_per_field_A_T * field_T).cwiseAbs().maxCoeff() / limits_.current_A);
    return use;
  }

  Eigen::Vector2d CoilLimiter::limited(const Eigen::Vector2d &field_T) const
  {
    const double use = use_of(field_T);
    return use > 1. ? (field_T / use).eval() : field_T;
  }

  Eigen::Vector2d CoilLimiter::moved(const Eigen::Vector2d &from_T, const Eigen::Vector2d &to_T,
                                     const double time_s) const
  {
    const Eigen::Vector2d to       = limited(to_T);
    const double          needed_s = time_to_move_s(from_T, to);
    return needed_s <= time_s ? to : (from_T + time_s / needed_s * (to - from_T)).eval();
  }

  double CoilLimiter::time_to_move_s(const Eigen::Vector2d &from_T, const Eigen::Vector2d &to_T) const
  {
    return (limited(to_T) - from_T).norm() / limits_.slew_rate_T_s;
  }
} // namespace swimtwin
