// Recordings as lines of the stream.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  struct RecordedLine
  {
    std::string text;  ///< of the stream; empty if there is a fault
    std::string where; ///< `file:line` of the row that it says; empty in a recording of lines
    std::string fault; ///< of a line or row that cannot be used: one sentence with what is wrong and the remedy
  };

  struct RecordedStream
  {
    std::vector<RecordedLine> lines;
    std::vector<std::string>  warnings; ///< of the tables
  };

  /// What a file holds: lines of the stream (`.jsonl`); a log `time_s,bx_T,by_T,x_m,y_m[,angle_rad]`, in units as its
  /// header says; or tracks with their sidecar as `calibrate` reads them (own tables, TrackMate, DeepLabCut). Tracks
  /// are played one after the other, each with its drive and after a restart; times of later ones are shifted behind
  /// those of earlier ones. A row that is wrong in itself becomes a line with a fault, about where it stands. Throws
  /// InputError that lists every problem of a file that is wrong as a whole.
  RecordedStream recorded_lines(const std::filesystem::path &file);

  /// False for tracks whose sidecar says that they were computed without.
  bool recorded_with_inertia(const std::filesystem::path &recording);
} // namespace swimtwin
