// Reflection of points and meshes at the plane y = const in 2D, z = const in 3D: the last coordinate.
#pragma once

#include <fom/geometry/simplex_mesh.h>

#include <optional>
#include <vector>

namespace swimtwin
{
  /// A mesh and its reflection at the plane, glued along the vertices on it (exactly there). They keep their numbers;
  /// the others' images follow. `image` receives the image of every vertex of the result.
  template <int dim>
  SimplexSoup<dim> reflect(const SimplexSoup<dim> &upper, double plane, std::vector<unsigned int> &image);

  /// The image of every node at the plane where the last coordinate is zero, bit by bit; none if a node has no image.
  template <int dim>
  std::optional<std::vector<unsigned int>> images_of_nodes(const SimplexMesh<dim> &mesh);

  /// What is above 0 keeps its digits at plane = 0.
  template <int dim>
  dealii::Point<dim> mirrored(dealii::Point<dim> x, const double plane = 0.)
  {
    x[dim - 1] = 2. * plane - x[dim - 1];
    return x;
  }
} // namespace swimtwin
