// Displacement of a tracked head, period by period.
#pragma once

#include <datasets/tracks/head_track.h>

#include <array>
#include <optional>
#include <vector>

namespace swimtwin
{
  /// Whole periods inside a track, counted from 1 at its `period_start_s`; none if last < first.
  struct PeriodRange
  {
    int first = 1, last = 0;
  };
  PeriodRange whole_periods(const HeadTrack &track);

  /// Displacement of whole periods, along a direction and across it.
  struct TrackPeriods
  {
    std::vector<int>    number;            ///< as in PeriodRange
    std::vector<double> along_m, across_m; ///< of each period; across is positive to the left of the direction
    double              frames_per_period = 0.;
    int                 n_lost_to_gaps    = 0; ///< periods left out because frames are missing at their ends
  };

  /// Displacement of each period that begins and ends inside the track. Positions at the ends of a period come from the
  /// cubic through the four nearest frames (two on each side; the first or last four at the ends of the track); where
  /// two of those are more than 2.5 median frame intervals apart, the periods that meet there are left out.
  /// `direction`: two numbers of any positive length.
  TrackPeriods displacement_of_periods(const HeadTrack &track, const std::array<double, 2> &direction);

  /// The direction in which the head leads at first: -(cos, sin) of the mean angle of the first whole period; none
  /// without angles or without a whole period.
  std::optional<std::array<double, 2>> initial_head_first(const HeadTrack &track);
} // namespace swimtwin
