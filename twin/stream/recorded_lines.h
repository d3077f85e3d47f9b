// Recordings as lines of the stream.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What a file holds: lines of the stream (`.jsonl`); a log `time_s,bx_T,by_T,x_m,y_m[,angle_rad]`, in units as its
  /// header says; or tracks with their sidecar as `calibrate` reads them (own tables, TrackMate, DeepLabCut). Tracks
  /// are played one after the other, each with its drive and after a restart; times of later ones are shifted behind
  /// those of earlier ones. Throws InputError that lists every problem.
  std::vector<std::string> recorded_lines(const std::filesystem::path &file);
} // namespace swimtwin
