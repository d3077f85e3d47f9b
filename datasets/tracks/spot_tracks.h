// Which spots of a table make the track of one swimmer.
#pragma once

#include <datasets/tracks/spot_columns.h>

#include <vector>

namespace swimtwin
{
  /// Rows of the track that the recording asks for, in order of time: its `track_id`, of which several are the pieces
  /// that the tracker cut one swimmer into; not needed if there is one track only. Noted as errors, with no rows left:
  /// no track or the wrong one, pieces that overlap, two spots at one time. A jump between pieces is warned of.
  std::vector<std::size_t> spots_of_track(const CsvTable &table, const SpotColumns &columns, const SpotClock &clock,
                                          const Recording &recording, DataProblems &problems);
} // namespace swimtwin
