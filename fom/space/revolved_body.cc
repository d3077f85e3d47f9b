#include <datasets/scene/tail_outline.h>
#include <fom/mesh/swimmer_outline.h>
#include <fom/space/body_surface.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    PlanarCurve ending_at(const PlanarCurve &curve, const Point<2> &end)
    {
      return {[=](const double t) { return t == 1. ? end : curve.position(t); }};
    }

    void append(std::vector<Point<3>> &curve, const std::vector<Point<3>> &next)
    {
      curve.insert(curve.end(), next.begin() + 1, next.end());
    }

    /// On the axis and around it: coarser than the surface, and at most five times as large as the tail is thick.
    SpatialSizeField size_about_axis(const Scene &scene)
    {
      constexpr double radii = 10.;
      return [=, tail = tail_outline(scene.head, *scene.tail), coarse = 1.5 * scene.numerics.mesh_size_m](
                 const Point<3> &x) { return std::min(coarse, radii * tail.half_height_m(x[0])); };
    }

    std::vector<Point<3>> axis_between(const Point<3> &start, const Point<3> &end, const SpatialSizeField &size)
    {
      std::vector<Point<3>> axis;
      for (const auto &x : divide(PlanarCurve::line({start[0], 0.}, {end[0], 0.}),
                                  [&](const Point<2> &xr) { return size(Point<3>(xr[0], 0., 0.)); }))
        axis.emplace_back(x[0], 0., 0.);
      axis.front() = start;
      axis.back()  = end;
      return axis;
    }

    /// Returns the trace of the tail's sides, from the root's rim to the tip.
    MeridianTrace add_tail(const OutlineCurves &curves, const SpatialSizeField &size, TailSurface &tail,
                           const MPI_Comm communicator)
    {
      Meridian root{curves.root, curves.size}, side{curves.side, curves.size};
      root.pieces.back()        = ending_at(root.pieces.back(), curves.root_end);
      MeridianTrace       trace = add_revolved(tail.surface, root, 0., root_patch, communicator);
      const MeridianTrace sides = add_revolved(tail.surface, side, 0., first_side_patch, communicator);
      append(trace.above, sides.above);
      append(trace.below, sides.below);
      tail.axis = axis_between(trace.above.front(), trace.above.back(), size);
      add_plane_patches(tail, trace, size, communicator);
      return sides;
    }
  } // namespace

  void add_plane_patches(TailSurface &tail, const MeridianTrace &trace, const SpatialSizeField &size,
                         const MPI_Comm communicator)
  {
    for (const auto *half : {&trace.above, &trace.below})
    {
      std::vector<Point<3>> loop(tail.axis.begin(), tail.axis.end() - 1);
      loop.insert(loop.end(), half->rbegin(), half->rend() - 1);
      auto patch   = plane_patch({loop}, 2, size);
      patch.number = plane_patch_number;
      add_patch(tail.surface, patch, communicator);
    }
  }

  BodySurface revolved_body(const Scene &scene, const MPI_Comm communicator)
  {
    OutlineCurves curves = outline_curves(scene.head, scene.tail, scene.numerics);
    if (scene.tail)
      curves.head.back() = ending_at(curves.head.back(), curves.root_end);
    BodySurface body;
    body.size  = [size = curves.size](const Point<3> &x) { return size(Point<2>(x[0], std::hypot(x[1], x[2]))); };
    body.trace = add_revolved(body.head, {curves.head, curves.size}, 0., 0, communicator);
    if (scene.tail)
    {
      body.tail.emplace();
      const MeridianTrace sides = add_tail(curves, size_about_axis(scene), *body.tail, communicator);
      append(body.trace.above, sides.above);
      append(body.trace.below, sides.below);
    }
    return body;
  }
} // namespace swimtwin
