#include <twin/lab/coil_driver.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double interval_s = 2e-3; // between samples of what the coils play
  }

  void CoilDriver::play_until(const double time_s, const double now_s)
  {
    if (is_ideal())
      return;
    const auto &[lag_s, step_T] = coils_;
    while (known_until_s_ < time_s + interval_s)
    {
      known_until_s_ += interval_s;
      const Eigen::Vector2d wanted = command_.value_T(known_until_s_);
      const double          share  = lag_s > 0. ? 1. - std::exp(-interval_s / lag_s) : 1.;
      current_T_ += share * (wanted - current_T_);
      const auto rounded = [step = step_T](const double v) { return step > 0. ? step * std::round(v / step) : v; };
      played_.add({known_until_s_, {rounded(current_T_.x()), rounded(current_T_.y())}});
    }
    played_.forget_before(now_s - 1.);
  }
} // namespace swimtwin
