#include <fom/surroundings/size_around.h>

#include <fom/meshing/graded_size.h>

namespace swimtwin
{
  using namespace dealii;

  SpatialSizeField size_around(const BodyMesh<3> &body, const std::vector<Point<3>> &x, const Numerics &numerics)
  {
    std::vector<std::pair<Point<3>, double>> prescribed;
    for (unsigned int i = 0; i < body.vertices.size(); ++i)
      prescribed.emplace_back(x[body.vertices[i]], body.surface_size[i]);
    return graded_size(prescribed, numerics.mesh_growth, numerics.mesh_size_far_m);
  }
} // namespace swimtwin
