// The walls of a domain in space, at z >= 0.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/surface/surface_builder.h>

namespace swimtwin
{
  /// What add_walls made: the name of the wall that each of its patches lies on, and where they meet the plane.
  struct SpatialWalls
  {
    int                           first_patch = 0;
    std::vector<std::string>      wall_of_patch; ///< from first_patch on
    std::vector<dealii::Point<3>> plane_loop;    ///< a closed quadratic loop: vertex, middle, ...
  };

  /// Add the outer walls of a box, channel, cylinder or sphere around `center`, which lies on the plane z = 0.
  /// Collective.
  SpatialWalls add_walls(QuadraticSurface &surface, const Domain &domain, const dealii::Point<3> &center,
                         const SpatialSizeField &size, MPI_Comm communicator);
} // namespace swimtwin
