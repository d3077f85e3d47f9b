#include <reports/run/shown_instants.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::vector<double> wanted_times_s(const ShownRun &run, const int n_instants)
    {
      const Rows          rows    = run.last_period();
      const double        start_s = rows.front().time_s, length_s = rows.back().time_s - start_s;
      const int           n_intervals = run.has_full_period() ? n_instants : n_instants - 1;
      std::vector<double> times_s;
      for (int k = 0; k < n_instants; ++k)
        times_s.push_back(start_s + length_s * k / n_intervals);
      return times_s;
    }
  } // namespace

  std::vector<std::size_t> closest_instants(const ShownRun &run, const int n_instants, const std::size_t n,
                                            const std::function<double(std::size_t)> &time_s_of)
  {
    std::vector<std::size_t> found;
    for (const double time_s : wanted_times_s(run, n_instants))
    {
      std::size_t best = 0;
      for (std::size_t i = 1; i < n; ++i)
        if (std::abs(time_s_of(i) - time_s) < std::abs(time_s_of(best) - time_s))
          best = i;
      if (found.empty() || found.back() != best)
        found.push_back(best);
    }
    return found;
  }

  double shown_time(const ShownRun &run, const double time_s)
  {
    return run.has_full_period() ? run.time(time_s) - run.time(run.last_period().front().time_s) : run.time(time_s);
  }
} // namespace swimtwin
