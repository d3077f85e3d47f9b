#include <datasets/run/work_balance.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  double WorkBalance::scale_J_m() const
  {
    constexpr double round_off = 1e-12;
    return std::abs(magnetic_J_m) > round_off * std::abs(dissipated_J_m) ? std::abs(magnetic_J_m)
                                                                         : std::abs(dissipated_J_m);
  }

  std::optional<double> WorkBalance::imbalance() const
  {
    const double scale = scale_J_m();
    return scale == 0. ? std::nullopt : std::optional(missing_J_m() / scale);
  }

  IntervalWork &IntervalWork::operator+=(const IntervalWork &next)
  {
    magnetic_J_m += next.magnetic_J_m;
    external_J_m += next.external_J_m;
    dissipated_J_m += next.dissipated_J_m;
    return *this;
  }

  WorkBalance work_balance(const std::span<const TrajectoryRow> rows,
                           const std::span<const IntervalWork>  first_intervals)
  {
    WorkBalance balance;
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const TrajectoryRow &a = rows[i - 1], &b = rows[i];
      const double         half_step_s = 0.5 * (b.time_s - a.time_s);
      balance.outflow_J_m += half_step_s * (b.kinetic_outflow_W_m + a.kinetic_outflow_W_m);
      balance.stabilization_J_m += half_step_s * (b.stabilization_W_m + a.stabilization_W_m);
      balance.numerical_J_m += half_step_s * (b.kinetic_growth_W_m + a.kinetic_growth_W_m);
      if (i <= first_intervals.size())
      {
        const IntervalWork &work = first_intervals[i - 1];
        balance.magnetic_J_m += work.magnetic_J_m;
        balance.external_J_m += work.external_J_m;
        balance.dissipated_J_m += work.dissipated_J_m;
        continue;
      }
      balance.magnetic_J_m += half_step_s * (b.magnetic_power_W_m + a.magnetic_power_W_m);
      balance.external_J_m += half_step_s * (b.external_power_W_m + a.external_power_W_m);
      balance.dissipated_J_m += half_step_s * (b.dissipation_W_m + a.dissipation_W_m);
    }
    const double kinetic_J_m = rows.back().kinetic_energy_J_m - rows.front().kinetic_energy_J_m;
    balance.stored_J_m       = rows.back().elastic_energy_J_m - rows.front().elastic_energy_J_m + kinetic_J_m;
    balance.numerical_J_m -= kinetic_J_m;
    return balance;
  }

  std::vector<WorkBalance> work_balance_per_period(const Trajectory &trajectory, const double period_s,
                                                   const std::span<const IntervalWork> first_intervals)
  {
    const std::vector<std::size_t> borders = period_borders(trajectory, period_s);
    std::vector<WorkBalance>       periods;
    for (std::size_t k = 1; k < borders.size(); ++k)
    {
      const std::span rows(trajectory.data() + borders[k - 1], borders[k] - borders[k - 1] + 1);
      periods.push_back(work_balance(rows, first_intervals.subspan(std::min(borders[k - 1], first_intervals.size()))));
    }
    return periods;
  }

  double largest_expected_imbalance(const int steps_per_period, const bool has_inertia)
  {
    const double ratio = 100. / steps_per_period, of_100_steps = has_inertia ? 0.0016 : 0.005;
    return std::clamp(of_100_steps * ratio * ratio, 0.001, 0.05);
  }

  std::optional<std::size_t> worst_period(const std::vector<WorkBalance> &periods)
  {
    std::optional<std::size_t> worst;
    for (std::size_t k = 0; k < periods.size(); ++k)
      if (const auto imbalance = periods[k].imbalance();
          imbalance && (!worst || std::abs(*imbalance) > std::abs(*periods[*worst].imbalance())))
        worst = k;
    return worst;
  }
} // namespace swimtwin
