// What later observations say of earlier instants: the smoother of H. E. Rauch, F. Tung and C. T. Striebel (AIAA
// Journal 3, 1965, p. 1445) on roots of covariances.
#pragma once

#include <twin/filter/window_filter.h>

#include <vector>

namespace swimtwin
{
  /// Beliefs at the nodes `first` to the latest of the filter's window, given all that it holds.
  std::vector<Belief> smoothed_beliefs(const WindowFilter &filter, int first = 0);
} // namespace swimtwin
