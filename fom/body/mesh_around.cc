#include <fom/body/mesh_around.h>

#include <datasets/scene/mirror_plane.h>
#include <fom/body/finer_mesh.h>
#include <fom/mesh/inverted_element.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    FluidMesh<2> make_mesh(const Swimmer<2> &swimmer, const Configuration<2> &configuration, const bool by_halves,
                           const MPI_Comm communicator)
    {
      const Scene &scene = swimmer.scene();
      const auto   make =
          by_halves ? make_symmetric_fluid_mesh : static_cast<decltype(&make_symmetric_fluid_mesh)>(make_fluid_mesh);
      return make(*scene.domain, swimmer.surface(configuration), swimmer.surface_mesh_size(), configuration.pose,
                  swimmer.pose_at_rest(), scene.numerics, communicator);
    }

    bool is_at_rest(const Swimmer<2> &swimmer, const Configuration<2> &configuration)
    {
      const auto rest = swimmer.pose_at_rest();
      return configuration.pose.center == rest.center && configuration.pose.angle == rest.angle &&
             std::all_of(configuration.shape.begin(), configuration.shape.end(),
                         [](const auto &d) { return d.norm_square() == 0.; });
    }

    /// Of a body in motion, whose surface is meshed already.
    [[noreturn]] void say_remedy(const ComputationError &error, const Numerics &numerics)
    {
      if (dynamic_cast<const InvertedElement *>(&error) == nullptr)
        throw ComputationError(error);
      throw InvertedElement(fmt::format("{}; lower [numerics] mesh_size_m = {} m", error.what(), numerics.mesh_size_m));
    }

    FluidMesh<2> make_mesh_or_advise(const Swimmer<2> &swimmer, const Configuration<2> &configuration,
                                     const bool by_halves, const MPI_Comm communicator)
    {
      try
      {
        return make_mesh(swimmer, configuration, by_halves, communicator);
      }
      catch (const ComputationError &error)
      {
        if (!is_at_rest(swimmer, configuration))
          say_remedy(error, swimmer.scene().numerics);
        refuse_mesh_size(swimmer.scene(), error, [&](const Scene &finer) {
          const Swimmer<2>   body(finer, communicator);
          const FluidMesh<2> mesh = make_mesh(body, body.configuration_at_rest(), by_halves, communicator);
          return worst_quality(mesh.mesh, mesh.mesh.nodes) >= finer.numerics.remesh_quality;
        });
      }
    }
  } // namespace

  FluidMesh<2> mesh_around(const Swimmer<2> &swimmer, const Configuration<2> &configuration,
                           const MPI_Comm communicator)
  {
    return make_mesh_or_advise(swimmer, configuration, solves_half(swimmer.scene()), communicator);
  }

  FluidMesh<2> mesh_whole_around(const Swimmer<2> &swimmer, const Configuration<2> &configuration,
                                 const MPI_Comm communicator)
  {
    return make_mesh_or_advise(swimmer, configuration, false, communicator);
  }
} // namespace swimtwin
