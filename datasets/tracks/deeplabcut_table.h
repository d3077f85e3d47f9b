// Body parts that DeepLabCut followed, as it writes them to CSV.
#pragma once

#include <datasets/tracks/head_track.h>

namespace swimtwin
{
  /// Whether a table begins with DeepLabCut's header rows.
  bool is_deeplabcut_table(const CsvTable &table);

  /// The track of the body part that the recording asks for (`body_part`, `individual`; not needed if there is one
  /// only).
  ///
  /// Three header rows (scorer, bodyparts, coords; with several animals also individuals), then per frame its number
  /// and `x, y, likelihood` of each part, in pixels. Frames whose likelihood is below the sidecar's `least_likelihood`,
  /// or that have no position, are left out with a warning. Needs `pixel_m` and `frame_s`. Problems are noted; empty
  /// when one of them is an error.
  std::vector<HeadTrack> deeplabcut_track(const CsvTable &table, const Recording &recording, const Camera &camera,
                                          DataProblems &problems);
} // namespace swimtwin
