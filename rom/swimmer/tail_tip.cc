#include <datasets/surface/simplex_edges.h>
#include <rom/swimmer/tail_tip.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Vertex at the other end of the edge from the tip; the tip itself if the mesh has no such edge.
    int start_of_last_edge(const ReducedTail &tail)
    {
      const int n_vertices = tail.dimension() + 1, n_edges = static_cast<int>(tail.cells.cols()) - n_vertices;
      for (Eigen::Index c = 0; c < tail.cells.rows(); ++c)
        for (int edge = 0; edge < n_edges; ++edge)
        {
          const int a = tail.cells(c, simplex_edges[edge][0]), b = tail.cells(c, simplex_edges[edge][1]),
                    middle = tail.cells(c, n_vertices + edge);
          if (middle == tail.before_tip_node && (a == tail.tip_node || b == tail.tip_node))
            return a == tail.tip_node ? b : a;
        }
      return tail.tip_node;
    }
  } // namespace

  TailTip::TailTip(const ReducedTail &tail) : amplitudes_(tail)
  {
    const std::array<int, 3> nodes = {start_of_last_edge(tail), tail.before_tip_node, tail.tip_node};
    for (std::size_t i = 0; i < nodes.size(); ++i)
      last_edge_[i] = {tail.nodes_m.row(nodes[i]).head<2>().transpose(), tail.modes_in_plane(nodes[i])};
  }

  Eigen::Vector2d TailTip::position_m(const ShapeVector &q) const
  {
    return last_edge_[2].position(amplitudes_.value(q));
  }

  double TailTip::angle_rad(const ShapeVector &q) const
  {
    const AmplitudeVector p = amplitudes_.value(q);
    const Eigen::Vector2d tangent =
        3. * last_edge_[2].position(p) - 4. * last_edge_[1].position(p) + last_edge_[0].position(p);
    return std::atan2(tangent.y(), tangent.x());
  }
} // namespace swimtwin
