#include <calibration/misfit/robust_loss.h>

#include <cmath>

namespace swimtwin
{
  double RobustLoss::value(const double r) const
  {
    const double s = r / width_;
    switch (kind_)
    {
    case LossKind::huber:
      return std::abs(s) <= 1. ? 0.5 * r * r : width_ * std::abs(r) - 0.5 * width_ * width_;
    case LossKind::pseudo_huber: // s^2 / (1 + sqrt(1 + s^2)): no cancellation for small s
      return r * r / (1. + std::sqrt(1. + s * s));
    case LossKind::cauchy:
      return 0.5 * width_ * width_ * std::log1p(s * s);
    default:
      return 0.5 * r * r;
    }
  }

  double RobustLoss::weight(const double r) const
  {
    const double s = r / width_;
    switch (kind_)
    {
    case LossKind::huber:
      return std::abs(s) <= 1. ? 1. : 1. / std::abs(s);
    case LossKind::pseudo_huber:
      return 1. / std::sqrt(1. + s * s);
    case LossKind::cauchy:
      return 1. / (1. + s * s);
    default:
      return 1.;
    }
  }

  double RobustLoss::slope(const double r) const
  {
    return weight(r) * r;
  }

  double RobustLoss::root(const double r) const
  {
    return std::copysign(std::sqrt(2. * value(r)), r);
  }

  double RobustLoss::root_slope(const double r) const
  {
    const double s = root(r);
    return std::abs(s) < 1e-8 ? 1. : slope(r) / s;
  }
} // namespace swimtwin
