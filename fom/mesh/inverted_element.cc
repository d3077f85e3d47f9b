#include <fom/mesh/inverted_element.h>

#include <datasets/surface/simplex_edges.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using CellPositions = std::array<Point<dim>, n_cell_nodes<dim>>;

    /// An edge of an element, and how far its middle is off the chord.
    struct CurvedEdge
    {
      double length_m, bulge_m, element_height_m;
    };

    /// Distance of the farthest other corner from an edge.
    template <int dim>
    double height_above(const CellPositions<dim> &x, const Point<dim> &a, const Point<dim> &b)
    {
      const Tensor<1, dim> along  = (b - a) / std::max(b.distance(a), std::numeric_limits<double>::min());
      double               height = 0.;
      for (unsigned int v = 0; v <= dim; ++v)
        height = std::max(height, ((x[v] - a) - ((x[v] - a) * along) * along).norm());
      return height;
    }

    template <int dim>
    CurvedEdge most_curved_edge(const CellPositions<dim> &x)
    {
      CurvedEdge most{0., 0., 0.};
      for (unsigned int e = 0; e + dim + 1 < n_cell_nodes<dim>; ++e)
      {
        const Point<dim> &a = x[simplex_edges[e][0]], &b = x[simplex_edges[e][1]];
        const double      bulge = (x[dim + 1 + e] - .5 * (a + Tensor<1, dim>(b))).norm();
        if (bulge > most.bulge_m)
          most = {a.distance(b), bulge, height_above<dim>(x, a, b)};
      }
      return most;
    }

    template <int dim>
    std::string cause(const CellPositions<dim> &x)
    {
      const auto [length, bulge, height] = most_curved_edge<dim>(x);
      if (bulge <= 1e-9 * length)
        return "its corners are on one line or in the wrong order";
      return fmt::format("an edge of {:.3g} m, too long for a curve of radius {:.2g} m, bulges by {:.2g} m where the "
                         "element is {:.2g} m high",
                         length, length * length / (8. * bulge) + bulge / 2., bulge, height);
    }
  } // namespace

  template <int dim>
  void refuse_inverted_elements(const SimplexMesh<dim> &mesh, const std::string &name)
  {
    double             worst = std::numeric_limits<double>::max();
    CellPositions<dim> at_worst{};
    for (const auto &cell : mesh.cells)
    {
      const CellPositions<dim> x       = cell_positions<dim>(cell, mesh.nodes);
      const double             quality = element_quality(x);
      if (!(quality >= worst))
      {
        worst    = quality;
        at_worst = x;
      }
    }
    if (worst > 0.)
      return;
    std::array<double, dim> middle{};
    for (unsigned int v = 0; v <= dim; ++v)
      for (int c = 0; c < dim; ++c)
        middle[c] += at_worst[v][c] / (dim + 1);
    throw InvertedElement(fmt::format("{} has an element inside out at ({:.4g}) m (quality {:.2f}): {}", name,
                                      fmt::join(middle, ", "), worst, cause<dim>(at_worst)));
  }

  template void refuse_inverted_elements<2>(const SimplexMesh<2> &, const std::string &);
  template void refuse_inverted_elements<3>(const SimplexMesh<3> &, const std::string &);
} // namespace swimtwin
