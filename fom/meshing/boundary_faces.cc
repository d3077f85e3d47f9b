#include <fom/meshing/boundary_faces.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    using Cell = std::array<unsigned int, 4>;

    /// Of a straight tetrahedron: 1 if equilateral, negative if inverted.
    double quality(const Cell &cell, const std::vector<Point<3>> &x)
    {
      double edges = 0.;
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < a; ++b)
          edges += (x[cell[a]] - x[cell[b]]).norm_square() / 6.;
      const double volume =
          cross_product_3d(x[cell[1]] - x[cell[0]], x[cell[2]] - x[cell[0]]) * (x[cell[3]] - x[cell[0]]);
      return std::sqrt(2.) * volume / (edges * std::sqrt(edges));
    }

    class Liberation
    {
    public:
      Liberation(SimplexSoup<3> &soup, const TriangleSurface &boundary) : soup_(soup)
      {
        for (const auto &triangle : boundary.triangles)
          for (int v = 0; v < 3; ++v)
            boundary_.insert(edge_between(triangle[v], triangle[(v + 1) % 3]));
        for (unsigned int n = 0; n < soup.cells.size(); ++n)
          note(n);
      }

      /// The edge to divide, if the cell has a bound corner; both ends are the same vertex if there is none.
      std::optional<Edge> edge_off_bound_corner(const Cell &cell) const
      {
        for (int corner = 0; corner < 4; ++corner)
          if (is_bound(cell, corner))
          {
            for (int i = 1; i < 4; ++i)
            {
              const Edge opposite = edge_between(cell[(corner + i) % 4], cell[(corner + i % 3 + 1) % 4]);
              if (!boundary_.count(opposite))
                return opposite;
            }
            return Edge{cell[corner], cell[corner]};
          }
        return std::nullopt;
      }

      /// An inner edge of a cell without volume, which gmsh leaves on plane pieces of the boundary.
      std::optional<Edge> flat_edge(const Cell &cell) const
      {
        constexpr double without_volume = 0.02;
        if (quality(cell, soup_.vertices) < without_volume)
          for (int a = 0; a < 4; ++a)
            for (int b = 0; b < a; ++b)
              if (const Edge inner = edge_between(cell[a], cell[b]); !boundary_.count(inner))
                return inner;
        return std::nullopt;
      }

      /// Divide all cells at an edge; `if_better`: only where their worst quality gains by it, which it need not in a
      /// wedge of the region. Returns whether they were.
      bool divide(const Edge &at, const bool if_better)
      {
        const unsigned int              m      = soup_.vertices.size();
        const std::vector<unsigned int> around = cells_at(at);
        std::vector<Cell>               halves;
        Point<3>                        center;
        double                          worst = 1.;
        for (const auto n : around)
        {
          worst = std::min(worst, quality(soup_.cells[n], soup_.vertices));
          for (const auto v : soup_.cells[n])
            center += soup_.vertices[v] / (4. * around.size());
          for (const auto from : at)
          {
            Cell half = soup_.cells[n];
            std::replace(half.begin(), half.end(), from, m);
            halves.push_back(half);
          }
        }
        const double best =
            place(Point<3>(.5 * (soup_.vertices[at[0]] + Tensor<1, 3>(soup_.vertices[at[1]]))), center, halves);
        if (if_better && best <= worst)
        {
          soup_.vertices.pop_back();
          return false;
        }
        for (unsigned int i = 0; i < around.size(); ++i)
        {
          soup_.cells[around[i]] = halves[2 * i];
          soup_.cells.push_back(halves[2 * i + 1]);
          note(around[i]);
          note(soup_.cells.size() - 1);
        }
        return true;
      }

      /// Divide one cell from its middle.
      void divide(const unsigned int n)
      {
        const Cell         cell = soup_.cells[n];
        const unsigned int m    = soup_.vertices.size();
        Point<3>           middle;
        for (const auto v : cell)
          middle += soup_.vertices[v] / 4.;
        soup_.vertices.push_back(middle);
        for (int v = 0; v < 4; ++v)
        {
          Cell part = cell;
          part[v]   = m;
          v == 0 ? soup_.cells[n] = part : soup_.cells.emplace_back(part);
          note(v == 0 ? n : soup_.cells.size() - 1);
        }
      }

    private:
      void note(const unsigned int n)
      {
        cells_of_vertex_.resize(soup_.vertices.size());
        for (const auto v : soup_.cells[n])
          cells_of_vertex_[v].push_back(n);
      }
      std::vector<unsigned int> cells_at(const Edge &edge) const
      {
        std::vector<unsigned int> cells;
        for (const auto n : cells_of_vertex_[edge[0]])
          if (has(soup_.cells[n], edge[0]) && has(soup_.cells[n], edge[1]))
            cells.push_back(n);
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        return cells;
      }
      /// Whether the three edges from a corner are on the boundary and nearly in a plane.
      bool is_bound(const Cell &cell, const int corner) const
      {
        constexpr double nearly_flat = 0.6; // of the volume that unit vectors span
        Tensor<1, 3>     along[3];
        for (int i = 1; i < 4; ++i)
        {
          const unsigned int a = cell[corner], b = cell[(corner + i) % 4];
          if (!boundary_.count(edge_between(a, b)))
            return false;
          along[i - 1] = (soup_.vertices[b] - soup_.vertices[a]) / soup_.vertices[b].distance(soup_.vertices[a]);
        }
        return std::abs(cross_product_3d(along[0], along[1]) * along[2]) < nearly_flat;
      }
      static bool has(const Cell &cell, const unsigned int v)
      {
        return std::find(cell.begin(), cell.end(), v) != cell.end();
      }

      /// Returns the worst quality there.
      double place(const Point<3> &middle, const Point<3> &center, const std::vector<Cell> &cells)
      {
        double   best  = -1.;
        Point<3> there = middle;
        soup_.vertices.push_back(middle);
        for (double push = 0.; push <= 2.; push += .1)
        {
          soup_.vertices.back() = middle + push * (center - middle);
          double worst          = 1.;
          for (const Cell &cell : cells)
            worst = std::min(worst, quality(cell, soup_.vertices));
          if (worst > best)
          {
            best  = worst;
            there = soup_.vertices.back();
          }
        }
        soup_.vertices.back() = there;
        return best;
      }

      SimplexSoup<3>                        &soup_;
      std::set<Edge>                         boundary_;
      std::vector<std::vector<unsigned int>> cells_of_vertex_; ///< some of them no longer
    };
    /// The cell that has these two vertices in this order, and its third vertex; there is one inside a region.
    std::array<unsigned int, 2> cell_across(const SimplexSoup<2> &soup, const unsigned int a, const unsigned int b)
    {
      for (unsigned int n = 0; n < soup.cells.size(); ++n)
        for (int v = 0; v < 3; ++v)
          if (const auto &cell = soup.cells[n]; cell[v] == a && cell[(v + 1) % 3] == b)
            return {n, cell[(v + 2) % 3]};
      return {};
    }

    /// Divide the edge of cell n that is opposite to its corner v.
    void divide_opposite_edge(SimplexSoup<2> &soup, const unsigned int n, const int v)
    {
      const auto         cell = soup.cells[n];
      const unsigned int p = cell[v], q = cell[(v + 1) % 3], r = cell[(v + 2) % 3], m = soup.vertices.size();
      const auto [other, o] = cell_across(soup, r, q);
      // Between the edge's middle and that of the quadrilateral around it: inside it.
      soup.vertices.push_back(Point<2>(.4 * (soup.vertices[q] + Tensor<1, 2>(soup.vertices[r])) +
                                       .1 * (soup.vertices[p] + Tensor<1, 2>(soup.vertices[o]))));
      soup.cells[n]     = {p, q, m};
      soup.cells[other] = {o, r, m};
      soup.cells.push_back({p, m, r});
      soup.cells.push_back({o, m, q});
    }
  } // namespace

  void free_corners_from_boundary(SimplexSoup<2> &soup, const std::set<Edge> &boundary)
  {
    const auto is_bound = [&](const unsigned int p, const unsigned int q, const unsigned int r) {
      constexpr double   obtuse = -0.6; // cosine
      const Tensor<1, 2> a = soup.vertices[q] - soup.vertices[p], b = soup.vertices[r] - soup.vertices[p];
      return boundary.count(edge_between(p, q)) && boundary.count(edge_between(p, r)) &&
             !boundary.count(edge_between(q, r)) && a * b < obtuse * a.norm() * b.norm();
    };
    for (unsigned int n = 0; n < soup.cells.size(); ++n)
      for (int v = 0; v < 3; ++v)
        if (const auto cell = soup.cells[n]; is_bound(cell[v], cell[(v + 1) % 3], cell[(v + 2) % 3]))
        {
          divide_opposite_edge(soup, n, v);
          break;
        }
  }

  void free_corners_from_boundary(SimplexSoup<3> &soup, const TriangleSurface &boundary)
  {
    Liberation liberation(soup, boundary);
    const auto most_flat_cells = soup.cells.size(); // a wedge may have ever thinner ones
    for (unsigned int n = 0, n_flat = 0; n < soup.cells.size(); ++n)
    {
      while (const auto at = liberation.edge_off_bound_corner(soup.cells[n]))
        if ((*at)[0] == (*at)[1])
          liberation.divide(n);
        else
          liberation.divide(*at, false);
      if (const auto at = liberation.flat_edge(soup.cells[n]); at && n_flat < most_flat_cells)
        if (liberation.divide(*at, true))
        {
          ++n_flat;
          --n; // its halves, once more
        }
    }
  }
} // namespace swimtwin
