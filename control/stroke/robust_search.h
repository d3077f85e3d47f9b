// One field for many swimmers: the best value that all of them, or all but a fraction, reach.
#pragma once

#include <control/stroke/field_search.h>

namespace swimtwin
{
  /// Minimise t such that the objective of every member but the worst n_left_out is at most t (the epigraph form;
  /// members are ranked anew at every field), and that all members keep to all limits. Terms are relative to the
  /// nominal swimmer's.
  FieldFound search_robust_field(const FieldTask &task, const std::vector<SwimmerParameters> &members, int n_left_out,
                                 const FieldVariables &variables, const FieldStart &start,
                                 const FieldSearchOptions &options);
} // namespace swimtwin
