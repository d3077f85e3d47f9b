#include <control/steering/mean_position.h>

#include <algorithm>

namespace swimtwin
{
  void MeanPosition::add(const double periods, const Eigen::Vector2d &position_m)
  {
    const Eigen::Vector2d added = times_.empty()
                                      ? Eigen::Vector2d::Zero().eval()
                                      : (0.5 * (periods - times_.back()) * (positions_.back() + position_m)).eval();
    integrals_.push_back(integrals_.empty() ? added : integrals_.back() + added);
    times_.push_back(periods);
    positions_.push_back(position_m);
  }

  Eigen::Vector2d MeanPosition::integral_at(const double periods) const
  {
    const auto after = std::upper_bound(times_.begin(), times_.end(), periods);
    if (after == times_.begin())
      return Eigen::Vector2d::Zero();
    const auto   i = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double s = periods - times_[i];
    if (i + 1 == times_.size())
      return integrals_[i] + s * positions_[i];
    const double length = times_[i + 1] - times_[i];
    return integrals_[i] + s * (positions_[i] + 0.5 * s / length * (positions_[i + 1] - positions_[i]));
  }

  Eigen::Vector2d MeanPosition::mean_at(const double periods) const
  {
    const double from = std::max(periods - 1., times_.front());
    return periods > from ? ((integral_at(periods) - integral_at(from)) / (periods - from)).eval() : positions_.front();
  }
} // namespace swimtwin
