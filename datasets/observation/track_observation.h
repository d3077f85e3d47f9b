// From a tracked head to a point of the curve of displacement against frequency.
#pragma once

#include <datasets/observation/observation_set.h>
#include <datasets/tracks/head_track.h>

#include <optional>

namespace swimtwin
{
  /// One point of the curve: the displacement of `sidecar.period`, or the mean over all whole periods after
  /// `skipped_periods`, with its standard error (the scatter between periods over the root of their number; at least
  /// what `position_sigma_m` makes of it). None after an error was noted: no direction, the period not in the track, no
  /// error bar to be had. Warnings: few frames or periods, gaps, a way that does not lead head first.
  std::optional<Observation> observe_track(const HeadTrack &track, const ObservationSidecar &sidecar,
                                           DataProblems &problems);
} // namespace swimtwin
