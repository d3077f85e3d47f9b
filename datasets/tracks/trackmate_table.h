// Spots of TrackMate, the tracker of Fiji, and of other trackers, as they export them.
#pragma once

#include <datasets/tracks/head_track.h>

#include <optional>

namespace swimtwin
{
  /// Whether a table has TrackMate's columns, or those of trackpy, Manual Tracking or MTrackJ.
  bool is_trackmate_table(const CsvTable &table);

  /// The row that holds TrackMate's keys where other lines stand above them.
  std::optional<std::size_t> find_row_of_keys(const CsvTable &table);

  /// The one track of a spots table that the recording asks for (`track_id`; not needed if there is one track only).
  ///
  /// TrackMate 7 and later ("Export to CSV" of the spots or tracks table) write four header rows: feature keys (LABEL,
  /// ID, TRACK_ID, QUALITY, POSITION_X, POSITION_Y, POSITION_Z, POSITION_T, FRAME, ...), names, short names, and units
  /// in parentheses (https://github.com/trackmate-sc/TrackMate/issues/191). Earlier versions, and ImageJ when it saves
  /// the table, write the keys alone; the sidecar then says the unit (`length_unit`). TRACK_ID is empty for a spot
  /// outside the tracks; rows need not be in the order of time. Positions in pixels need `pixel_m`; times are
  /// POSITION_T in its unit, or FRAME times `frame_s` when that is given. Problems are noted; empty when one of them is
  /// an error.
  std::vector<HeadTrack> trackmate_track(const CsvTable &table, const Recording &recording, const Camera &camera,
                                         DataProblems &problems);
} // namespace swimtwin
