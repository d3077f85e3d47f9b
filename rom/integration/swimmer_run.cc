#include <rom/integration/swimmer_run.h>

#include <rom/swimmer/head_frame.h>

#include <cmath>

namespace swimtwin
{
  double PeriodWork::imbalance() const
  {
    const double reference = magnetic != 0. ? std::abs(magnetic) : std::abs(dissipated);
    return reference > 0. ? (magnetic - dissipated - elastic_change - kinetic_change) / reference : 0.;
  }

  std::vector<double> displacement_per_period(const SwimmerRun &run, const double heading_rad)
  {
    std::vector<double> displacements;
    for (std::size_t i = 1; i < run.at_period_end.size(); ++i)
      displacements.push_back(head_first(heading_rad).dot((run.at_period_end[i] - run.at_period_end[i - 1]).head<2>()));
    return displacements;
  }

  Eigen::MatrixXd displacement_sensitivities(const SwimmerRun &run, const double heading_rad)
  {
    const auto &by_parameters = run.sensitivity_at_period_end;
    if (by_parameters.empty())
      return {};
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(by_parameters.size()) - 1, by_parameters.front().cols());
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
    {
      const auto k = static_cast<std::size_t>(i);
      rows.row(i)  = head_first(heading_rad).transpose() * (by_parameters[k + 1] - by_parameters[k]).topRows<2>();
    }
    return rows;
  }
} // namespace swimtwin
