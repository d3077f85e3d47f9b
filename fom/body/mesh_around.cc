#include <fom/body/mesh_around.h>

#include <datasets/mirror_plane.h>

namespace swimtwin
{
  FluidMesh<2> mesh_around(const Swimmer<2> &swimmer, const Configuration<2> &configuration,
                           const MPI_Comm communicator)
  {
    const Scene &scene = swimmer.scene();
    const auto   mesh  = solves_half(scene) ? make_symmetric_fluid_mesh
                                            : static_cast<decltype(&make_symmetric_fluid_mesh)>(make_fluid_mesh);
    return mesh(*scene.domain, swimmer.surface(configuration), swimmer.surface_mesh_size(), configuration.pose,
                swimmer.pose_at_rest(), scene.numerics, communicator);
  }
} // namespace swimtwin
