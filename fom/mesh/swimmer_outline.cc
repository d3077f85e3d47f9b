#include <fom/mesh/swimmer_outline.h>

#include <datasets/scene/tail_outline.h>
#include <fom/geometry/reflection.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  using namespace dealii;
  using std::numbers::pi;

  namespace
  {
    /// Upper half of the head from the nose to the back, in pieces, with the corners that the flow's pressure is
    /// singular at.
    struct HeadShapeCurves
    {
      std::vector<PlanarCurve> pieces_to_root; ///< nose -> where the tail's upper side starts (or the back)
      std::vector<PlanarCurve> root;           ///< axis -> there
      std::vector<Point<2>>    corners;
      Point<2>                 root_end;
    };

    HeadShapeCurves rectangle_curves(const std::array<double, 2> &size, const double root_half_height)
    {
      const double    a = size[0] / 2, b = size[1] / 2;
      HeadShapeCurves head;
      head.pieces_to_root = {PlanarCurve::line({-a, 0}, {-a, b}), PlanarCurve::line({-a, b}, {a, b})};
      head.corners        = {{-a, b}, {a, b}};
      head.root_end       = {a, root_half_height};
      if (root_half_height < b * (1 - 1e-12))
        head.pieces_to_root.push_back(PlanarCurve::line({a, b}, head.root_end));
      if (root_half_height > 0.)
        head.root = {PlanarCurve::line({a, 0}, head.root_end)};
      return head;
    }

    HeadShapeCurves ellipse_curves(const std::array<double, 2> &size, const double root_half_height)
    {
      const std::array<double, 2> radii      = {size[0] / 2, size[1] / 2};
      const double                root_angle = std::asin(std::min(1., root_half_height / radii[1]));
      HeadShapeCurves             head;
      head.pieces_to_root = {PlanarCurve::arc({0, 0}, radii, pi, root_angle)};
      head.root_end       = {radii[0] * std::cos(root_angle), root_half_height};
      if (root_half_height > 0.)
      {
        head.root    = {PlanarCurve::arc({0, 0}, radii, 0., root_angle)};
        head.corners = {head.root_end};
      }
      return head;
    }

    HeadShapeCurves head_curves(const Head &head, const double root_half_height)
    {
      return head.shape == HeadShape::rectangle ? rectangle_curves(head.size_m, root_half_height)
                                                : ellipse_curves(head.size_m, root_half_height);
    }

    /// Through the points of a profile, from where the head's curves end bit by bit.
    PlanarCurve curved_side(const TailOutline &tail, const Point<2> &root_end)
    {
      const PlanarCurve graph =
          PlanarCurve::graph([=](const double x) { return tail.half_height_m(x); }, tail.x_root_m, tail.x_end_m);
      return {[=](const double t) { return t == 0. ? root_end : graph.position(t); }};
    }

    /// Upper side of the tail from the root to the tip on the axis.
    std::vector<PlanarCurve> side_curves(const Head &head, const Tail &tail, const Point<2> &root_end)
    {
      const double r = tail.tip_height_m / 2, x_tip = head.size_m[0] / 2 + tail.length_m;
      const bool   is_flat = tail.tip == TipShape::flat;
      const double x_end   = is_flat ? x_tip : x_tip - r;
      return {tail.profile_m.empty() ? PlanarCurve::line(root_end, {x_end, r})
                                     : curved_side(tail_outline(head, tail), root_end),
              is_flat ? PlanarCurve::line({x_end, r}, {x_tip, 0}) : PlanarCurve::arc({x_end, 0}, {r, r}, pi / 2, 0.)};
    }

    std::vector<Point<2>> divide_all(const std::vector<PlanarCurve> &curves, const SizeField &size)
    {
      std::vector<Point<2>> nodes;
      for (const auto &curve : curves)
      {
        const auto piece = divide(curve, size);
        nodes.insert(nodes.end(), piece.begin() + (nodes.empty() ? 0 : 1), piece.end());
      }
      return nodes;
    }

    SizeField surface_size(const std::vector<Point<2>> &fine_points, const Numerics &numerics)
    {
      std::vector<std::pair<Point<2>, double>> prescribed;
      const double fine = numerics.mesh_size_corner_m > 0. ? numerics.mesh_size_corner_m : numerics.mesh_size_m;
      for (const auto &x : fine_points)
        for (const auto &side : {x, mirrored(x)})
          prescribed.emplace_back(side, fine);
      return graded_size(std::move(prescribed), numerics.mesh_growth, numerics.mesh_size_m);
    }
  } // namespace

  OutlineCurves outline_curves(const Head &head, const std::optional<Tail> &tail, const Numerics &numerics)
  {
    const auto            shape = head_curves(head, tail ? tail->root_height_m / 2 : 0.);
    std::vector<Point<2>> fine  = shape.corners;
    OutlineCurves         curves{shape.pieces_to_root, {}, {}, shape.root_end, {}, {}};
    if (tail)
    {
      const double x_tip = head.size_m[0] / 2 + tail->length_m;
      fine.push_back(tail->tip == TipShape::flat ? Point<2>(x_tip, tail->tip_height_m / 2) : Point<2>(x_tip, 0));
      curves.side = side_curves(head, *tail, shape.root_end);
      curves.root = shape.root;
      curves.tip  = Point<2>(x_tip, 0);
    }
    curves.size = surface_size(fine, numerics);
    return curves;
  }

  SwimmerOutline make_outline(const Head &head, const std::optional<Tail> &tail, const Numerics &numerics)
  {
    const OutlineCurves curves = outline_curves(head, tail, numerics);
    SwimmerOutline      outline;
    outline.size       = curves.size;
    outline.upper_head = divide_all(curves.head, outline.size);
    if (tail)
    {
      outline.upper_side = divide_all(curves.side, outline.size);
      outline.upper_root = divide_all(curves.root, outline.size);
      // The axis is a mirror line: its points must not carry the rounding of sines.
      outline.upper_side.back()[1] = outline.upper_root.front()[1] = 0.;
      outline.upper_side.front() = outline.upper_root.back() = outline.upper_head.back();
    }
    else
      outline.upper_head.back()[1] = 0.;
    outline.upper_head.front()[1] = 0.;
    return outline;
  }

  std::vector<Point<2>> SwimmerOutline::surface() const
  {
    // Upper half from nose to tip, clockwise; its mirror image walks the same way below.
    std::vector<Point<2>> upper = upper_head;
    if (!upper_side.empty())
      upper.insert(upper.end(), upper_side.begin() + 1, upper_side.end());
    std::vector<Point<2>> loop;
    for (const auto &x : upper)
      loop.push_back(mirrored(x));
    loop.insert(loop.end(), upper.rbegin() + 1, upper.rend() - 1);
    return loop;
  }
} // namespace swimtwin
