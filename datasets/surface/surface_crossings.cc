#include <datasets/surface/surface_crossings.h>

#include <datasets/surface/triangle_tree.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    __extension__ using Whole = __int128; ///< holds a product of three differences of coordinates

    using GridPoint = std::array<long long, 3>;

    /// Coordinates as whole numbers up to 2^40.
    class Grid
    {
    public:
      explicit Grid(const Extent &box) : low_(box.low), step_(std::ldexp(box.size().maxCoeff(), -40)) {}

      std::vector<GridPoint> operator()(const std::vector<Vector3d> &points) const
      {
        std::vector<GridPoint> on_grid;
        for (const Vector3d &x : points)
        {
          auto &place = on_grid.emplace_back();
          for (int c = 0; c < 3; ++c)
            place[c] = std::llround((x[c] - low_[c]) / step_);
        }
        return on_grid;
      }

    private:
      Vector3d low_;
      double   step_;
    };

    int sign(const Whole value)
    {
      return (value > 0) - (value < 0);
    }

    /// On which side of the plane through a, b, c the point d is.
    int side(const GridPoint &a, const GridPoint &b, const GridPoint &c, const GridPoint &d)
    {
      Whole u[3], v[3], w[3];
      for (int i = 0; i < 3; ++i)
      {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        w[i] = d[i] - a[i];
      }
      return sign((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                  (u[0] * v[1] - u[1] * v[0]) * w[2]);
    }

    using Triangle = std::array<GridPoint, 3>;

    /// The coordinate along which a triangle is seen largest.
    int widest_view(const Triangle &t)
    {
      int   widest = 0;
      Whole most   = -1;
      for (int k = 0; k < 3; ++k)
      {
        const int   i = (k + 1) % 3, j = (k + 2) % 3;
        const Whole area =
            Whole(t[1][i] - t[0][i]) * (t[2][j] - t[0][j]) - Whole(t[1][j] - t[0][j]) * (t[2][i] - t[0][i]);
        if (const Whole size = area < 0 ? -area : area; size > most)
        {
          most   = size;
          widest = k;
        }
      }
      return widest;
    }

    /// In a plane, seen along a coordinate.
    struct PlaneView
    {
      int along;

      int turn(const GridPoint &a, const GridPoint &b, const GridPoint &c) const
      {
        const int i = (along + 1) % 3, j = (along + 2) % 3;
        return sign(Whole(b[i] - a[i]) * (c[j] - a[j]) - Whole(b[j] - a[j]) * (c[i] - a[i]));
      }
      bool is_within_box(const GridPoint &a, const GridPoint &b, const GridPoint &x) const
      {
        const auto is_between = [&](const int i) {
          return std::min(a[i], b[i]) <= x[i] && x[i] <= std::max(a[i], b[i]);
        };
        return is_between((along + 1) % 3) && is_between((along + 2) % 3);
      }
      bool segments_meet(const GridPoint &p, const GridPoint &q, const GridPoint &a, const GridPoint &b) const
      {
        const int pa = turn(p, q, a), pb = turn(p, q, b), ap = turn(a, b, p), aq = turn(a, b, q);
        if (pa * pb < 0 && ap * aq < 0)
          return true;
        return (pa == 0 && is_within_box(p, q, a)) || (pb == 0 && is_within_box(p, q, b)) ||
               (ap == 0 && is_within_box(a, b, p)) || (aq == 0 && is_within_box(a, b, q));
      }
      bool contains(const Triangle &t, const GridPoint &x) const
      {
        const int s0 = turn(t[0], t[1], x), s1 = turn(t[1], t[2], x), s2 = turn(t[2], t[0], x);
        return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
      }
    };

    /// Ends and edges included.
    bool segment_meets(const GridPoint &p, const GridPoint &q, const Triangle &t)
    {
      const int sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
      if (sp * sq > 0)
        return false;
      if (sp == 0 && sq == 0)
      {
        const PlaneView view{widest_view(t)};
        return view.contains(t, p) || view.segments_meet(p, q, t[0], t[1]) || view.segments_meet(p, q, t[1], t[2]) ||
               view.segments_meet(p, q, t[2], t[0]);
      }
      const int s0 = side(p, q, t[0], t[1]), s1 = side(p, q, t[1], t[2]), s2 = side(p, q, t[2], t[0]);
      return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
    }

    bool triangles_meet(const Triangle &a, const Triangle &b)
    {
      for (int k = 0; k < 3; ++k)
        if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a))
          return true;
      return false;
    }

    Triangle corners(const std::vector<GridPoint> &points, const std::array<unsigned int, 3> &triangle)
    {
      return {points[triangle[0]], points[triangle[1]], points[triangle[2]]};
    }

    /// With what they share in front.
    unsigned int put_shared_first(std::array<unsigned int, 3> &a, std::array<unsigned int, 3> &b)
    {
      unsigned int n = 0;
      for (unsigned int i = 0; i < 3; ++i)
        if (const auto same = std::find(b.begin() + n, b.end(), a[i]); same != b.end())
        {
          std::swap(*same, b[n]);
          std::swap(a[i], a[n++]);
        }
      return n;
    }

    bool neighbours_cross(const std::vector<GridPoint> &points, std::array<unsigned int, 3> a,
                          std::array<unsigned int, 3> b)
    {
      const unsigned int n_shared = put_shared_first(a, b);
      const Triangle     s = corners(points, a), t = corners(points, b);
      if (n_shared == 0)
        return triangles_meet(s, t);
      if (n_shared == 1)
        return segment_meets(s[1], s[2], t) || segment_meets(t[1], t[2], s);
      if (n_shared == 2) // folded onto each other
      {
        const PlaneView view{widest_view(s)};
        return side(s[0], s[1], s[2], t[2]) == 0 && view.turn(s[0], s[1], s[2]) * view.turn(s[0], s[1], t[2]) > 0;
      }
      return true;
    }

    void note(Crossings &found, const Vector3d &near)
    {
      if (found.n_pairs++ == 0)
        found.first = near;
    }

    Vector3d middle(const std::vector<Vector3d> &points, const std::array<unsigned int, 3> &triangle)
    {
      return (points[triangle[0]] + points[triangle[1]] + points[triangle[2]]) / 3.;
    }

    /// Every triangle of the tree whose box meets that of a triangle.
    template <typename Visit>
    void visit_near(const TriangleTree &tree, const TreeBox &box, const Visit &visit)
    {
      namespace index = boost::geometry::index;
      for (auto near = tree.qbegin(index::intersects(box)); near != tree.qend(); ++near)
        visit(near->second);
    }
  } // namespace

  Crossings self_crossings(const std::vector<Vector3d> &points, const FlatTriangles &triangles)
  {
    const auto on_grid = Grid(extent(points))(points);
    const auto tree    = tree_of(points, triangles);
    Crossings  found;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      visit_near(tree, box_of(points, triangles[t]), [&](const unsigned int other) {
        if (other > t && neighbours_cross(on_grid, triangles[t], triangles[other]))
          note(found, middle(points, triangles[t]));
      });
    return found;
  }

  Crossings crossings(const std::vector<Vector3d> &points, const FlatTriangles &triangles,
                      const std::vector<Vector3d> &other_points, const FlatTriangles &other_triangles)
  {
    const Extent a = extent(points), b = extent(other_points);
    const Grid   grid({a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)});
    const auto   on_grid = grid(points), others_on_grid = grid(other_points);
    const auto   tree = tree_of(other_points, other_triangles);
    Crossings    found;
    for (const auto &triangle : triangles)
      visit_near(tree, box_of(points, triangle), [&](const unsigned int other) {
        if (triangles_meet(corners(on_grid, triangle), corners(others_on_grid, other_triangles[other])))
          note(found, middle(points, triangle));
      });
    return found;
  }
} // namespace swimtwin
