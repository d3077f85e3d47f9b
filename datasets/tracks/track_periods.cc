#include <datasets/scene/median_step.h>
#include <datasets/tracks/track_periods.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    using Vector = std::array<double, 2>;

    constexpr double largest_gap = 2.5;  // of the frames around the end of a period, in median intervals
    constexpr double time_slack  = 1e-6; // of a period, for a track that ends with it

    /// First of the four frames around a time.
    std::size_t stencil(const std::vector<double> &time_s, const double time)
    {
      const auto after = std::upper_bound(time_s.begin(), time_s.end(), time) - time_s.begin();
      return static_cast<std::size_t>(
          std::clamp<std::ptrdiff_t>(after - 2, 0, static_cast<std::ptrdiff_t>(time_s.size()) - 4));
    }

    bool has_gap(const std::vector<double> &time_s, const double time, const double median_s)
    {
      const std::size_t first = stencil(time_s, time);
      for (std::size_t i = first + 1; i < first + 4; ++i)
        if (time_s[i] - time_s[i - 1] > largest_gap * median_s)
          return true;
      return false;
    }

    /// Lagrange's cubic through the four frames around a time.
    double interpolate(const std::vector<double> &time_s, const std::vector<double> &values, const double time)
    {
      const std::size_t first = stencil(time_s, time);
      double            sum   = 0.;
      for (std::size_t i = first; i < first + 4; ++i)
      {
        double weight = 1.;
        for (std::size_t j = first; j < first + 4; ++j)
          if (j != i)
            weight *= (time - time_s[j]) / (time_s[i] - time_s[j]);
        sum += weight * values[i];
      }
      return sum;
    }

    Vector place(const HeadTrack &track, const double time)
    {
      return {interpolate(track.time_s, track.x_m, time), interpolate(track.time_s, track.y_m, time)};
    }

    double end_of_period(const HeadTrack &track, const int number)
    {
      return track.period_start_s + number / track.frequency_Hz;
    }

    double mean_of(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
    }
  } // namespace

  PeriodRange whole_periods(const HeadTrack &track)
  {
    const auto   periods_to = [&](const double time) { return (time - track.period_start_s) * track.frequency_Hz; };
    const double before     = std::ceil(periods_to(track.time_s.front()) - time_slack);
    const double after      = std::floor(periods_to(track.time_s.back()) + time_slack);
    return {static_cast<int>(std::max(before, 0.)) + 1, static_cast<int>(std::max(after, 0.))};
  }

  TrackPeriods displacement_of_periods(const HeadTrack &track, const Vector &direction)
  {
    TrackPeriods      periods;
    const double      length = std::hypot(direction[0], direction[1]);
    const Vector      e{direction[0] / length, direction[1] / length};
    const double      median_s = median_step(track.time_s);
    const PeriodRange whole    = whole_periods(track);
    periods.frames_per_period  = 1. / (track.frequency_Hz * median_s);
    for (int number = whole.first; number <= whole.last; ++number)
    {
      const double begin = end_of_period(track, number - 1), end = end_of_period(track, number);
      if (has_gap(track.time_s, begin, median_s) || has_gap(track.time_s, end, median_s))
      {
        ++periods.n_lost_to_gaps;
        continue;
      }
      const Vector a = place(track, begin), b = place(track, end);
      const Vector way{b[0] - a[0], b[1] - a[1]};
      periods.number.push_back(number);
      periods.along_m.push_back(e[0] * way[0] + e[1] * way[1]);
      periods.across_m.push_back(e[0] * way[1] - e[1] * way[0]);
    }
    return periods;
  }

  std::optional<Vector> initial_head_first(const HeadTrack &track)
  {
    const PeriodRange whole = whole_periods(track);
    if (track.angle_rad.empty() || whole.last < whole.first)
      return std::nullopt;
    const double        begin = end_of_period(track, whole.first - 1), end = end_of_period(track, whole.first);
    std::vector<double> angles;
    for (std::size_t i = 0; i < track.time_s.size(); ++i)
      if (track.time_s[i] >= begin && track.time_s[i] < end)
        angles.push_back(track.angle_rad[i]);
    if (angles.empty())
      return std::nullopt;
    return Vector{-std::cos(mean_of(angles)), -std::sin(mean_of(angles))};
  }
} // namespace swimtwin
