// What the live page shows of an estimate: fewer numbers than the stream says, and the body's axis as points.
#pragma once

#include <twin/stream/records.h>

#include <string>

namespace swimtwin
{
  /// A line of JSON, type "view": pose, axis (head's centre to the tip) in the laboratory, parameters, trust, flags,
  /// and the field that plays.
  std::string view_line(const SwimmerTwin &twin, const TailAxis &axis, const EstimateRecord &record);

  /// The page itself: one file that asks for nothing but its own events.
  extern const char *const live_page;
} // namespace swimtwin
