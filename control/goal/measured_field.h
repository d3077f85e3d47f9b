// A field and its motion, measured more finely than a search does.
#pragma once

#include <control/stroke/field_search.h>

namespace swimtwin
{
  /// Everything that does not come from a search. `start` is a state near the periodic motion.
  PlannedField measured_field(const std::string &name, const FieldTask &task, const Drive &drive,
                              const SwimmerState &start);
  /// The same with what the searches for it found and cost; the trace is that of the best.
  PlannedField measured_field(const std::string &name, const FieldTask &task, const std::vector<FieldFound> &found);

  /// The drive of a planned field.
  Drive        drive_of(const PlannedField &field);
  SwimmerState start_of(const PlannedField &field);

  /// Samples (T) at the coils' rate: the number per period is the nearest whole one, at least 16.
  FieldProgram sampled_program(const Drive &drive, double sample_rate_Hz);
} // namespace swimtwin
