#include <rom/swimmer_run.h>

#include <cmath>

namespace swimtwin
{
  double PeriodWork::imbalance() const
  {
    const double reference = magnetic != 0. ? std::abs(magnetic) : std::abs(dissipated);
    return reference > 0. ? (magnetic - dissipated - elastic_change) / reference : 0.;
  }

  std::vector<double> displacement_per_period(const SwimmerRun &run, const double heading_rad)
  {
    const Eigen::Vector2d head_first(-std::cos(heading_rad), -std::sin(heading_rad));
    std::vector<double>   displacements;
    for (std::size_t i = 1; i < run.at_period_end.size(); ++i)
      displacements.push_back(head_first.dot((run.at_period_end[i] - run.at_period_end[i - 1]).head<2>()));
    return displacements;
  }
} // namespace swimtwin
