// A film, flat and as wide all along, clamped in the back of a cylinder.
#include <fom/mesh/swimmer_outline.h>
#include <fom/space/body_surface.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    using Curve = std::vector<Point<3>>; ///< quadratic: vertex, middle, vertex, ...

    constexpr int back_of_head_patch = 2;

    Curve divided_edge(const Point<3> &from, const Point<3> &to, const SpatialSizeField &size)
    {
      const Tensor<1, 3> along  = to - from;
      const double       length = along.norm();
      Curve              curve;
      for (const double s : division(PlanarCurve::line({0., 0.}, {length, 0.}),
                                     [&](const Point<2> &at) { return size(from + at[0] / length * along); }))
        curve.push_back(s == 1. ? to : from + s * along);
      for (auto &x : curve)
        for (int c = 0; c < 3; ++c)
          if (from[c] == to[c])
            x[c] = from[c];
      return curve;
    }

    Curve reversed(const Curve &curve)
    {
      return {curve.rbegin(), curve.rend()};
    }

    /// A closed loop, without its first node again, from curves that follow each other.
    Curve closed(const std::vector<Curve> &curves)
    {
      Curve loop;
      for (const auto &curve : curves)
        loop.insert(loop.end(), curve.begin(), curve.end() - 1);
      return loop;
    }

    /// A chain from curves that follow each other.
    Curve chained(const std::vector<Curve> &curves)
    {
      Curve chain = curves.front();
      for (unsigned int i = 1; i < curves.size(); ++i)
        chain.insert(chain.end(), curves[i].begin() + 1, curves[i].end());
      return chain;
    }

    /// One of the faces above and below, with what lies between it and the axis at both ends.
    struct Side
    {
      Curve root_at_plane, tip_at_plane; ///< from the axis, at z = 0
      Curve at_plane, at_edge;           ///< from root to tip, at z = 0 and at half the width
      Curve root, tip;                   ///< from z = 0 to half the width
    };

    Side make_side(const Scene &scene, const double sign, const SpatialSizeField &size)
    {
      const Tail  &tail = *scene.tail;
      const double x0 = .5 * scene.head.size_m[0], x1 = x0 + tail.length_m, z = .5 * tail.width_m,
                   y0 = .5 * sign * tail.root_height_m, y1 = .5 * sign * tail.tip_height_m;
      const Point<3> root(x0, y0, 0.), tip(x1, y1, 0.), root_edge(x0, y0, z), tip_edge(x1, y1, z);
      return {divided_edge({x0, 0., 0.}, root, size), divided_edge({x1, 0., 0.}, tip, size),
              divided_edge(root, tip, size),          divided_edge(root_edge, tip_edge, size),
              divided_edge(root, root_edge, size),    divided_edge(tip, tip_edge, size)};
    }

    class Film
    {
    public:
      Film(const Scene &scene, const SpatialSizeField &size, const MPI_Comm communicator)
          : size_(size), communicator_(communicator), upper_(make_side(scene, 1., size)),
            lower_(make_side(scene, -1., size)), root_edge_(divided_edge(lower_.root.back(), upper_.root.back(), size)),
            tip_edge_(divided_edge(lower_.tip.back(), upper_.tip.back(), size))
      {
      }

      void add_to(TailSurface &tail) const
      {
        add(tail.surface,
            {lower_.root, root_edge_, reversed(upper_.root), reversed(upper_.root_at_plane), lower_.root_at_plane}, 0,
            root_patch);
        add_slope(tail.surface, upper_, first_side_patch);
        add_slope(tail.surface, lower_, first_side_patch + 1);
        add(tail.surface, {lower_.at_edge, tip_edge_, reversed(upper_.at_edge), reversed(root_edge_)}, 2,
            first_side_patch + 2);
        add(tail.surface,
            {lower_.tip, tip_edge_, reversed(upper_.tip), reversed(upper_.tip_at_plane), lower_.tip_at_plane}, 0,
            first_side_patch + 3);
      }
      /// From the axis at the root over the sides to the axis at the tip.
      MeridianTrace trace() const { return {around(upper_), around(lower_)}; }
      /// The root's outline without the plane, from below to above.
      std::vector<Curve> rim() const { return {lower_.root, root_edge_, reversed(upper_.root)}; }

      void add(QuadraticSurface &surface, const std::vector<Curve> &loop, const int normal, const int number) const
      {
        auto patch   = plane_patch({closed(loop)}, normal, size_);
        patch.number = number;
        add_patch(surface, patch, communicator_);
      }

    private:
      static Curve around(const Side &side)
      {
        return chained({side.root_at_plane, side.at_plane, reversed(side.tip_at_plane)});
      }

      /// In the chart of x and z; the height is a linear function of x.
      void add_slope(QuadraticSurface &surface, const Side &side, const int number) const
      {
        const Point<3> &from = side.at_plane.front(), &to = side.at_plane.back();
        auto            patch =
            plane_patch({closed({side.at_plane, side.tip, reversed(side.at_edge), reversed(side.root)})}, 1, size_);
        patch.number   = number;
        patch.position = [from, to](const Point<2> &p) {
          const double s = (p[0] - from[0]) / (to[0] - from[0]);
          return Point<3>(p[0], from[1] + s * (to[1] - from[1]), p[1]);
        };
        patch.size = [size = size_, position = patch.position](const Point<2> &p) { return size(position(p)); };
        add_patch(surface, patch, communicator_);
      }

      SpatialSizeField size_;
      MPI_Comm         communicator_;
      Side             upper_, lower_;
      Curve            root_edge_, tip_edge_; ///< at half the width, from below to above
    };
  } // namespace

  BodySurface film_body(const Scene &scene, const MPI_Comm communicator)
  {
    const OutlineCurves curves = outline_curves(scene.head, scene.tail, scene.numerics);
    BodySurface         body;
    // Heights of the film are along y, radii of the head all around.
    body.size = [size = curves.size](const Point<3> &x) {
      return std::min(size(Point<2>(x[0], std::abs(x[1]))), size(Point<2>(x[0], std::hypot(x[1], x[2]))));
    };
    const Film film(scene, body.size, communicator);

    const Meridian front_and_side{{curves.head[0], curves.head[1]}, curves.size};
    body.trace           = add_revolved(body.head, front_and_side, 0., 0, communicator);
    const Point<3> above = body.trace.above.back(), below = body.trace.below.back();
    const auto     tail = film.trace();
    const auto     rim  = film.rim();
    const Curve    over = divided_edge(above, rim.back().back(), body.size),
                under   = divided_edge(below, rim.front().front(), body.size);
    film.add(
        body.head,
        {half_circle(front_and_side, Point<2>(above[0], above[1]), 0.), under, rim[0], rim[1], rim[2], reversed(over)},
        0, back_of_head_patch);

    body.tail.emplace();
    film.add_to(*body.tail);
    const SpatialSizeField size = [coarse = 1.5 * scene.numerics.mesh_size_m](const Point<3> &) { return coarse; };
    body.tail->axis             = divided_edge({above[0], 0., 0.}, tail.above.back(), size);
    add_plane_patches(*body.tail, tail, size, communicator);

    const auto side = [&](const Curve &head, const Curve &back, const Curve &around) {
      const auto root = std::find(around.begin(), around.end(), back.back());
      return chained({head, back, Curve(root, around.end())});
    };
    body.trace = {side(body.trace.above, over, tail.above), side(body.trace.below, under, tail.below)};
    return body;
  }
} // namespace swimtwin
