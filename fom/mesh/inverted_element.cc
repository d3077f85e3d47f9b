#include <fom/mesh/inverted_element.h>

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
    using CellPositions = std::array<Point<2>, 6>;

    /// An edge of an element, and how far its middle is off the chord.
    struct CurvedEdge
    {
      double length_m, bulge_m, element_height_m;
    };

    CurvedEdge most_curved_edge(const CellPositions &x)
    {
      const Tensor<1, 2> a = x[1] - x[0], b = x[2] - x[0];
      const double       twice_area = std::abs(a[0] * b[1] - a[1] * b[0]);
      CurvedEdge         most{0., 0., 0.};
      for (unsigned int e = 0; e < 3; ++e)
      {
        const double length = x[e].distance(x[(e + 1) % 3]);
        const double bulge  = (x[3 + e] - .5 * (x[e] + Tensor<1, 2>(x[(e + 1) % 3]))).norm();
        if (bulge > most.bulge_m)
          most = {length, bulge, length > 0. ? twice_area / length : 0.};
      }
      return most;
    }

    std::string cause(const CellPositions &x)
    {
      const auto [length, bulge, height] = most_curved_edge(x);
      if (bulge <= 1e-9 * length)
        return "its corners are on one line or in the wrong order";
      return fmt::format("an edge of {:.3g} m, too long for a curve of radius {:.2g} m, bulges by {:.2g} m where the "
                         "element is {:.2g} m high",
                         length, length * length / (8. * bulge) + bulge / 2., bulge, height);
    }
  } // namespace

  void refuse_inverted_elements(const SimplexMesh<2> &mesh, const std::string &name)
  {
    double        worst = std::numeric_limits<double>::max();
    CellPositions at_worst{};
    for (const auto &cell : mesh.cells)
    {
      const CellPositions x       = cell_positions<2>(cell, mesh.nodes);
      const double        quality = element_quality(x);
      if (!(quality >= worst))
      {
        worst    = quality;
        at_worst = x;
      }
    }
    if (worst > 0.)
      return;
    const Point<2> middle = Point<2>((at_worst[0] + Tensor<1, 2>(at_worst[1]) + Tensor<1, 2>(at_worst[2])) / 3.);
    throw InvertedElement(fmt::format("{} has an element inside out at ({:.4g}, {:.4g}) m (quality {:.2f}): {}", name,
                                      middle[0], middle[1], worst, cause(at_worst)));
  }
} // namespace swimtwin
