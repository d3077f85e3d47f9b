#include <twin/filter/smoother.h>
#include <twin/steering/recent_motion.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double looked_at_periods = 1.1; // means are over one

    void add_instant(const double periods, const Eigen::VectorXd &mean, RecentMotion &motion)
    {
      motion.position_m.add(periods, mean.head<2>());
      motion.angle_rad.add(periods, {mean[2], 0.});
    }
  } // namespace

  std::optional<RecentMotion> recent_motion(SwimmerTwin &twin, const PeriodClock &clock, const double now_s)
  {
    if (!twin.has_started())
      return {};
    const WindowFilter &filter = twin.filter();
    const double        from_s = now_s - looked_at_periods / clock.frequency_Hz;
    int                 first  = 0;
    while (first + 1 < filter.n_nodes() && filter.node(first + 1).time_s <= from_s)
      ++first;
    RecentMotion              motion;
    const std::vector<Belief> smoothed = smoothed_beliefs(filter, first);
    for (std::size_t i = 0; i < smoothed.size(); ++i)
      add_instant(clock.periods(filter.node(first + static_cast<int>(i)).time_s), smoothed[i].mean, motion);
    motion.now           = twin.belief();
    const double seen_s  = twin.now_s();
    const double ahead_s = now_s - seen_s;
    const int    n       = std::max(0, static_cast<int>(std::ceil(ahead_s / twin.process().largest_step_s() - 1e-9)));
    for (int i = 0; i < n; ++i)
    {
      if (!twin.filter().predict(seen_s + ahead_s * i / n, seen_s + ahead_s * (i + 1) / n, motion.now))
        return {};
      add_instant(clock.periods(seen_s + ahead_s * (i + 1) / n), motion.now.mean, motion);
    }
    return motion;
  }
} // namespace swimtwin
