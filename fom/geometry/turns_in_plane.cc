#include <fom/geometry/turns_in_plane.h>

#include <deal.II/base/tensor.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  std::vector<double> turns_in_plane(const SimplexMesh<dim> &mesh, const std::vector<Point<dim>> &positions)
  {
    // Cosines and sines are summed up, so that turns of any size have a mean.
    std::vector<Tensor<1, 2>> sum(mesh.n_nodes());
    for (const auto &cell : mesh.cells)
    {
      Tensor<2, dim> before, now;
      for (int edge = 0; edge < dim; ++edge)
        for (int c = 0; c < dim; ++c)
        {
          before[c][edge] = mesh.nodes[cell[1 + edge]][c] - mesh.nodes[cell[0]][c];
          now[c][edge]    = positions[cell[1 + edge]][c] - positions[cell[0]][c];
        }
      const Tensor<2, dim> F = now * invert(before);
      Tensor<1, 2>         turn;
      turn[0] = F[0][0] + F[1][1];
      turn[1] = F[1][0] - F[0][1];
      turn /= turn.norm();
      for (const unsigned int node : cell)
        sum[node] += turn;
    }
    std::vector<double> angles;
    for (const auto &turn : sum)
      angles.push_back(std::atan2(turn[1], turn[0]));
    return angles;
  }

  template std::vector<double> turns_in_plane(const SimplexMesh<2> &, const std::vector<Point<2>> &);
  template std::vector<double> turns_in_plane(const SimplexMesh<3> &, const std::vector<Point<3>> &);
} // namespace swimtwin
