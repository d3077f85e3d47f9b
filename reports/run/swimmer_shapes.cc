#include <reports/run/swimmer_shapes.h>

#include <datasets/scene/swimmer_clearance.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace swimtwin
{
  namespace
  {
    constexpr int n_chords_per_edge = 4;

    struct Edge
    {
      int from = 0, middle = 0, to = 0;
    };

    std::vector<Edge> boundary_edges(const Eigen::MatrixXi &cells)
    {
      std::map<std::pair<int, int>, std::vector<Edge>> edges;
      for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
        for (Eigen::Index k = 0; k < 3; ++k)
        {
          const Edge edge{cells(cell, k), cells(cell, 3 + k), cells(cell, (k + 1) % 3)};
          edges[std::minmax(edge.from, edge.to)].push_back(edge);
        }
      std::vector<Edge> boundary;
      for (const auto &[vertices, owners] : edges)
        if (owners.size() == 1)
          boundary.push_back(owners.front());
      return boundary;
    }

    /// Takes the edge that continues the chain at `vertex` out of `edges`, whichever way it points.
    std::vector<Edge>::iterator find_next(std::vector<Edge> &edges, const int vertex)
    {
      return std::find_if(edges.begin(), edges.end(),
                          [&](const Edge &edge) { return edge.from == vertex || edge.to == vertex; });
    }

    std::array<double, 2> place(const Eigen::Vector2d &point, const Pose &pose)
    {
      const double c = std::cos(pose.angle_rad), s = std::sin(pose.angle_rad);
      return {pose.x_m + c * point[0] - s * point[1], pose.y_m + s * point[0] + c * point[1]};
    }

    /// Faces of tetrahedra that lie in the plane of motion, z = 0, as quadratic triangles.
    Eigen::MatrixXi section_in_plane(const Eigen::MatrixXi &cells, const Eigen::MatrixXd &nodes_m)
    {
      constexpr int face[4][6] = {{0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 8, 7}, {0, 2, 3, 6, 9, 7}, {1, 2, 3, 5, 9, 8}};
      std::map<std::array<int, 3>, Eigen::RowVectorXi> triangles; // each is a face of two cells
      for (Eigen::Index cell = 0; cell < cells.rows(); ++cell)
        for (const auto &corners : face)
        {
          Eigen::RowVectorXi triangle(6);
          for (int i = 0; i < 6; ++i)
            triangle[i] = cells(cell, corners[i]);
          std::array<int, 3> key{triangle[0], triangle[1], triangle[2]};
          std::sort(key.begin(), key.end());
          if (std::all_of(key.begin(), key.end(), [&](const int node) { return nodes_m(node, 2) == 0.; }))
            triangles.emplace(key, triangle);
        }
      Eigen::MatrixXi section(triangles.size(), 6);
      Eigen::Index    row = 0;
      for (const auto &[key, triangle] : triangles)
        section.row(row++) = triangle;
      return section;
    }

    Outline curved_outline(const std::vector<int> &chain, const Eigen::MatrixXd &points, const Pose &pose)
    {
      Outline outline;
      for (std::size_t i = 0; i < chain.size(); i += 2)
      {
        const Eigen::Vector2d a = points.row(chain[i]).head<2>(), m = points.row(chain[i + 1]).head<2>();
        const Eigen::Vector2d b = points.row(chain[(i + 2) % chain.size()]).head<2>();
        for (int k = 0; k < n_chords_per_edge; ++k)
        {
          const double s = static_cast<double>(k) / n_chords_per_edge;
          outline.push_back(place((1. - s) * (1. - 2. * s) * a + 4. * s * (1. - s) * m + s * (2. * s - 1.) * b, pose));
        }
      }
      return outline;
    }
  } // namespace

  Outline head_outline(const Head &head, const Pose &pose)
  {
    Scene alone;
    alone.head           = head;
    alone.head.center_m  = {pose.x_m, pose.y_m};
    alone.head.angle_rad = pose.angle_rad;
    return swimmer_outline(alone);
  }

  std::vector<std::vector<int>> boundary_chains(const Eigen::MatrixXi &cells)
  {
    std::vector<Edge>             edges = boundary_edges(cells);
    std::vector<std::vector<int>> chains;
    while (!edges.empty())
    {
      std::vector<int> &chain  = chains.emplace_back();
      int               vertex = edges.back().from;
      for (auto next = find_next(edges, vertex); next != edges.end(); next = find_next(edges, vertex))
      {
        chain.insert(chain.end(), {vertex, next->middle});
        vertex = next->from == vertex ? next->to : next->from;
        edges.erase(next);
      }
    }
    return chains;
  }

  std::vector<Outline> tail_outlines(const SnapshotSet &snapshots, const std::size_t snapshot)
  {
    const auto            row          = static_cast<Eigen::Index>(snapshot);
    const Eigen::VectorXd displacement = snapshots.tail_displacement_m.row(row);
    Eigen::MatrixXd       points       = snapshots.tail_nodes_m;
    for (Eigen::Index node = 0; node < points.rows(); ++node)
      points.row(node).head<2>() += displacement.segment<2>(points.cols() * node);

    const Pose           pose{snapshots.pose(row, 0), snapshots.pose(row, 1), snapshots.pose(row, 2)};
    std::vector<Outline> outlines;
    const bool           is_in_space = points.cols() == 3;
    for (const std::vector<int> &chain : boundary_chains(
             is_in_space ? section_in_plane(snapshots.tail_cells, snapshots.tail_nodes_m) : snapshots.tail_cells))
      outlines.push_back(curved_outline(chain, points, pose));
    return outlines;
  }
} // namespace swimtwin
