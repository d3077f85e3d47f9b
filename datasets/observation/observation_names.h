// Names of several data sets, by which tables and pictures tell them apart.
#pragma once

#include <datasets/observation/observation_set.h>

#include <vector>

namespace swimtwin
{
  /// Sets of one name are called by their file's ending too, or by their folders, as far as is needed: `monday/run` and
  /// `tuesday/run`.
  void name_apart(std::vector<ObservationSet> &sets);

  /// A file that was named twice would count twice.
  void refuse_repeated_files(const std::vector<ObservationSet> &sets, DataProblems &problems);
} // namespace swimtwin
