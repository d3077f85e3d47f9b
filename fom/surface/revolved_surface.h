// Half of a surface of revolution about an axis along x: what lies at z >= 0.
#pragma once

#include <fom/surface/surface_builder.h>

namespace swimtwin
{
  /// A chain of curves in the half plane of x (first) and radius r >= 0, walked with growing arc length; it may begin
  /// and end on the axis, and nowhere else touch it.
  struct Meridian
  {
    std::vector<PlanarCurve> pieces;
    SizeField                size; ///< wanted edge length (m) at (x, r)
  };

  /// Where the half surface meets the plane z = 0: quadratic curves (vertex, middle, vertex, ...) from the meridian's
  /// first end to its last, on the side of larger y and on the other. They share the ends that are on the axis.
  struct MeridianTrace
  {
    std::vector<dealii::Point<3>> above, below;
  };

  /// The nodes of half of the circle about the axis through (x, r), from above to below through z > 0, as add_revolved
  /// divides it.
  std::vector<dealii::Point<3>> half_circle(const Meridian &meridian, const dealii::Point<2> &xr, double axis_y_m);

  /// Divide the meridian and the circles between its pieces, and add one or two patches for every piece, numbered
  /// `first_patch` + its place in the chain. Patches are meshed on conformal charts, so that triangles keep their
  /// shapes on the surface. `axis_y_m`: of the axis, in the plane z = 0. Collective.
  MeridianTrace add_revolved(QuadraticSurface &surface, const Meridian &meridian, double axis_y_m, int first_patch,
                             MPI_Comm communicator);
} // namespace swimtwin
