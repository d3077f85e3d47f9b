// The edges of quadratic triangles and tetrahedra, in the order in which cells list their middles.
#pragma once

#include <array>

namespace swimtwin
{
  /// Ends among the cell's vertices; the first three are a triangle's.
  constexpr std::array<std::array<int, 2>, 6> simplex_edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
} // namespace swimtwin
