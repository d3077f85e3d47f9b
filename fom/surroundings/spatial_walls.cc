#include <fom/surface/revolved_surface.h>
#include <fom/surroundings/spatial_walls.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr int first_wall_patch = 2000;

    using Curve = std::vector<Point<3>>; ///< quadratic: vertex, middle, vertex, ...

    Curve divided_line(const Point<3> &from, const Point<3> &to, const SpatialSizeField &size)
    {
      const double       length = from.distance(to);
      const Tensor<1, 3> along  = (to - from) / length;
      const SizeField    on_it  = [&](const Point<2> &s) { return size(from + s[0] * along); };
      const auto         nodes  = divide(PlanarCurve::line({0., 0.}, {length, 0.}), on_it, 2);
      Curve              curve;
      for (const auto &s : nodes)
      {
        Point<3> x = from + s[0] * along;
        for (int c = 0; c < 3; ++c)
          if (from[c] == to[c])
            x[c] = from[c];
        curve.push_back(x);
      }
      curve.front() = from;
      curve.back()  = to;
      return curve;
    }

    /// Edges of the half box, each divided once, by their two corners. Corner 4 k + 2 j + i has the i-th x, j-th y and
    /// k-th z.
    class HalfBox
    {
    public:
      HalfBox(const Domain &domain, const Point<3> &center, const SpatialSizeField &size) : size_(size)
      {
        const double half[3] = {domain.size_m[0] / 2, domain.size_m[1] / 2, domain.size_z_m / 2};
        for (int corner = 0; corner < 8; ++corner)
        {
          Point<3> x = center;
          for (int c = 0; c < 2; ++c)
            x[c] += (corner >> c & 1 ? 1. : -1.) * half[c];
          x[2] = corner >> 2 & 1 ? half[2] : 0.;
          corners_.push_back(x);
        }
      }

      /// Closed quadratic loop through four corners.
      Curve loop(const std::array<int, 4> &corners)
      {
        Curve loop;
        for (int i = 0; i < 4; ++i)
        {
          const Curve edge = along(corners[i], corners[(i + 1) % 4]);
          loop.insert(loop.end(), edge.begin(), edge.end() - 1);
        }
        return loop;
      }

    private:
      Curve along(const int a, const int b)
      {
        const auto [entry, is_new] = edges_.try_emplace({std::min(a, b), std::max(a, b)});
        if (is_new)
          entry->second = divided_line(corners_[std::min(a, b)], corners_[std::max(a, b)], size_);
        Curve curve = entry->second;
        if (a > b)
          std::reverse(curve.begin(), curve.end());
        return curve;
      }

      const SpatialSizeField             &size_;
      std::vector<Point<3>>               corners_;
      std::map<std::array<int, 2>, Curve> edges_;
    };

    SpatialWalls add_box(QuadraticSurface &surface, const Domain &domain, const Point<3> &center,
                         const SpatialSizeField &size, const MPI_Comm communicator)
    {
      struct Face
      {
        const char        *wall;
        std::array<int, 4> corners;
        int                normal;
      };
      const std::vector<Face> faces = {{"left", {0, 2, 6, 4}, 0},
                                       {"right", {1, 3, 7, 5}, 0},
                                       {"bottom", {0, 1, 5, 4}, 1},
                                       {"top", {2, 3, 7, 6}, 1},
                                       {"front", {4, 5, 7, 6}, 2}};
      HalfBox                 box(domain, center, size);
      SpatialWalls            walls{first_wall_patch, {}, box.loop({0, 1, 3, 2})};
      for (const auto &[wall, corners, normal] : faces)
      {
        auto patch   = plane_patch({box.loop(corners)}, normal, size);
        patch.number = first_wall_patch + walls.wall_of_patch.size();
        walls.wall_of_patch.emplace_back(wall);
        add_patch(surface, patch, communicator);
      }
      return walls;
    }

    SpatialWalls add_round(QuadraticSurface &surface, const Domain &domain, const Point<3> &center,
                           const SpatialSizeField &size, const MPI_Comm communicator)
    {
      const double x = center[0], R = domain.radius_m;
      // Sizes differ around the axis where the swimmer is off it: the smallest counts.
      Meridian     meridian{{}, [&](const Point<2> &xr) {
                          double smallest = std::numeric_limits<double>::infinity();
                          for (int k = 0; k <= 4; ++k)
                          {
                            const double angle = std::numbers::pi * k / 4;
                            smallest = std::min(smallest, size(Point<3>(xr[0], center[1] + xr[1] * std::cos(angle),
                                                                        xr[1] * std::sin(angle))));
                          }
                          return smallest;
                        }};
      SpatialWalls walls{first_wall_patch, {"outer"}, {}};
      if (domain.shape == DomainShape::sphere)
        meridian.pieces = {PlanarCurve::arc({x, 0.}, {R, R}, std::numbers::pi, 0.)};
      else
      {
        const double a      = domain.size_m[0] / 2;
        meridian.pieces     = {PlanarCurve::line({x - a, 0.}, {x - a, R}), PlanarCurve::line({x - a, R}, {x + a, R}),
                               PlanarCurve::line({x + a, R}, {x + a, 0.})};
        walls.wall_of_patch = {"left", "outer", "right"};
      }
      const MeridianTrace trace = add_revolved(surface, meridian, center[1], first_wall_patch, communicator);
      walls.plane_loop          = {trace.above.begin(), trace.above.end()};
      walls.plane_loop.insert(walls.plane_loop.end(), trace.below.rbegin() + 1, trace.below.rend() - 1);
      return walls;
    }
  } // namespace

  SpatialWalls add_walls(QuadraticSurface &surface, const Domain &domain, const Point<3> &center,
                         const SpatialSizeField &size, const MPI_Comm communicator)
  {
    return domain.shape == DomainShape::cylinder || domain.shape == DomainShape::sphere
               ? add_round(surface, domain, center, size, communicator)
               : add_box(surface, domain, center, size, communicator);
  }
} // namespace swimtwin
