#include <datasets/observation/track_observation.h>
#include <datasets/tracks/track_periods.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    constexpr double few_frames = 10., too_few_frames = 4.; // per period
    constexpr int    few_periods = 5;
    constexpr double degree = std::numbers::pi / 180., largest_drift = 10. * degree;

    double mean(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
    }

    double standard_deviation(const std::vector<double> &values)
    {
      if (values.size() < 2)
        return 0.;
      double sum = 0.;
      for (const double value : values)
        sum += std::pow(value - mean(values), 2);
      return std::sqrt(sum / static_cast<double>(values.size() - 1));
    }

    /// Keep the periods that the sidecar asks for.
    TrackPeriods select(const TrackPeriods &all, const ObservationSidecar &sidecar)
    {
      TrackPeriods some = all;
      some.number.clear(), some.along_m.clear(), some.across_m.clear();
      for (std::size_t i = 0; i < all.number.size(); ++i)
        if (sidecar.period ? all.number[i] == *sidecar.period : all.number[i] > sidecar.camera->skipped_periods)
        {
          some.number.push_back(all.number[i]);
          some.along_m.push_back(all.along_m[i]);
          some.across_m.push_back(all.across_m[i]);
        }
      return some;
    }

    std::string name_of(const HeadTrack &track)
    {
      return fmt::format("{}: the track at {:.4g} Hz", track.where, track.frequency_Hz);
    }

    void require_periods(const HeadTrack &track, const ObservationSidecar &sidecar, const TrackPeriods &used,
                         DataProblems &problems)
    {
      const PeriodRange whole = whole_periods(track);
      const std::string has =
          whole.last < whole.first ? "no whole period" : fmt::format("whole periods {} to {}", whole.first, whole.last);
      if (used.number.empty() && sidecar.period)
        problems.error(
            fmt::format("{} has {}, not period {}; film longer, or correct period or period_start_s = {} of the "
                        "sidecar.",
                        name_of(track), has, *sidecar.period, track.period_start_s));
      else if (used.number.empty())
        problems.error(fmt::format("{} has {} and skipped_periods = {}; nothing is left: film longer, or skip less.",
                                   name_of(track), has, sidecar.camera->skipped_periods));
    }

    void warn_of_quality(const HeadTrack &track, const ObservationSidecar &sidecar, const TrackPeriods &used,
                         const int n_lost, DataProblems &problems)
    {
      if (used.frames_per_period < few_frames)
        problems.warning(
            fmt::format("{} has {:.1f} frames per period; with fewer than {} the ends of a period are known "
                        "badly.",
                        name_of(track), used.frames_per_period, few_frames));
      if (n_lost > 0)
        problems.warning(fmt::format("{}: {} periods are left out because frames are missing where they begin or end.",
                                     name_of(track), n_lost));
      const int n = static_cast<int>(used.number.size());
      if (!sidecar.period && n < few_periods)
        problems.warning(fmt::format("{}: the mean is over {} periods, and its standard error itself uncertain by "
                                     "{:.0f} %; film at least {}.",
                                     name_of(track), n, 100. / std::sqrt(2. * std::max(n - 1, 1)), few_periods));
    }

    void warn_of_drift(const HeadTrack &track, const Observation &point, DataProblems &problems)
    {
      const bool seen = std::abs(point.displacement_m) > 3. * point.sigma_m;
      if (seen && std::abs(point.heading_drift_rad) > largest_drift)
        problems.warning(fmt::format("{}: the way made points {:.0f} degrees away from head_first; only its part along "
                                     "head_first counts. Turn head_first if the camera was turned, or film before the "
                                     "swimmer turns.",
                                     name_of(track), point.heading_drift_rad / degree));
    }

    /// Standard error of the mean displacement, which is the way from the first end to the last over their number: of
    /// what a position is off, only those two count.
    std::optional<double> standard_error(const HeadTrack &track, const ObservationSidecar &sidecar,
                                         const TrackPeriods &used, DataProblems &problems)
    {
      const double n         = static_cast<double>(used.number.size());
      const double of_places = std::numbers::sqrt2 * sidecar.camera->position_sigma_m.value_or(0.) / n;
      const double sigma     = std::max(of_places, standard_deviation(used.along_m) / std::sqrt(n));
      if (sigma > 0.)
        return sigma;
      problems.error(
          fmt::format("{} gives no error bar from {} period(s); give the standard deviation of a position in the "
                      "sidecar, [camera] position_sigma_m.",
                      name_of(track), used.number.size()));
      return std::nullopt;
    }
  } // namespace

  std::optional<Observation> observe_track(const HeadTrack &track, const ObservationSidecar &sidecar,
                                           DataProblems &problems)
  {
    const std::optional<std::array<double, 2>> direction =
        sidecar.camera->head_first ? sidecar.camera->head_first : initial_head_first(track);
    if (!direction)
    {
      problems.error(
          fmt::format("{} has no angles; give the direction of the head in the sidecar, [camera] head_first, "
                      "[-1, 0] for a head to the left of its tail.",
                      name_of(track)));
      return std::nullopt;
    }
    const TrackPeriods all = displacement_of_periods(track, *direction), used = select(all, sidecar);
    require_periods(track, sidecar, used, problems);
    if (used.number.empty())
      return std::nullopt;
    if (used.frames_per_period < too_few_frames)
      problems.error(fmt::format("{} has {:.1f} frames per period; at least {} are needed: film faster.",
                                 name_of(track), used.frames_per_period, too_few_frames));
    warn_of_quality(track, sidecar, used, all.n_lost_to_gaps, problems);
    const std::optional<double> sigma_m = standard_error(track, sidecar, used, problems);
    const double                along = mean(used.along_m), across = mean(used.across_m);
    Observation                 point{track.frequency_Hz,
                      along,
                      sigma_m.value_or(0.),
                      track.where,
                      static_cast<int>(used.number.size()),
                      standard_deviation(used.along_m),
                      std::atan2(across, std::abs(along))};
    warn_of_drift(track, point, problems);
    return sigma_m ? std::optional(point) : std::nullopt;
  }
} // namespace swimtwin
