#include <fom/body/mesh_around.h>

#include <datasets/scene/mesh_rules.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/swimmer_clearance.h>
#include <datasets/surface/closed_surface.h>
#include <fom/body/finer_mesh.h>
#include <fom/mesh/inverted_element.h>
#include <fom/meshing/gmsh_session.h>

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

    template <int dim>
    bool is_at_rest(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration)
    {
      return configuration.pose == swimmer.pose_at_rest() &&
             std::all_of(configuration.shape.begin(), configuration.shape.end(),
                         [](const auto &d) { return d.norm_square() == 0.; });
    }

    /// Where no mirror image is known. A domain that moves along is meshed where it rests, and turned with the head.
    FluidMesh<3> make_whole_mesh(const Swimmer<3> &swimmer, Configuration<3> configuration, const MPI_Comm communicator)
    {
      const Domain      &domain = *swimmer.scene().domain;
      const RigidPose<3> pose = configuration.pose, rest = swimmer.pose_at_rest();
      if (domain.moves_with_swimmer)
        configuration.pose = rest;
      FluidMesh<3> fluid =
          make_whole_fluid_mesh(domain, swimmer.body(), swimmer.surface(configuration),
                                {domain.center_m[0], domain.center_m[1], 0.}, swimmer.scene().numerics, communicator);
      if (domain.moves_with_swimmer)
        for (auto &x : fluid.mesh.nodes)
          x = pose.to_laboratory(rest.to_head_frame(x));
      return fluid;
    }

    /// At rest made by halves in any case but around and within surfaces that are read; that it is its own image counts
    /// only where half of it is solved.
    FluidMesh<3> make_mesh(const Swimmer<3> &swimmer, const Configuration<3> &configuration, const bool by_halves,
                           const MPI_Comm communicator)
    {
      if (swimmer.scene().has_surfaces() || (!by_halves && !is_at_rest(swimmer, configuration)))
        return make_whole_mesh(swimmer, configuration, communicator);
      const Domain  &domain = *swimmer.scene().domain;
      const Point<3> center(domain.center_m[0], domain.center_m[1], 0.);
      const auto moved = [&] { return configuration.pose.to_laboratory(swimmer.pose_at_rest().to_head_frame(center)); };
      FluidMesh<3> mesh =
          make_fluid_mesh(domain, swimmer.body(), swimmer.surface(configuration),
                          domain.moves_with_swimmer ? moved() : center, swimmer.scene().numerics, communicator);
      if (!by_halves)
        mesh.image_of_vertex.clear();
      return mesh;
    }

    /// Of a body in motion, whose surface is meshed already.
    [[noreturn]] void say_remedy(const ComputationError &error, const Scene &scene)
    {
      const std::string wave = scene.tail && scene.tail->is_driven() ? ", or [tail.wave] angle_rad or waves" : "";
      const std::string finer =
          scene.head.surface ? "mesh the surface anew, finer"
                             : fmt::format("lower [numerics] mesh_size_m = {} m{}", scene.numerics.mesh_size_m, wave);
      if (dynamic_cast<const CrossedSurfaces *>(&error) != nullptr)
        throw CrossedSurfaces(fmt::format("{}; {}, or keep the swimmer from the wall", error.what(), finer));
      if (dynamic_cast<const InvertedElement *>(&error) != nullptr)
        throw InvertedElement(fmt::format("{}; {}", error.what(), finer));
      throw ComputationError(wave.empty() ? error.what() : fmt::format("{}; {}", error.what(), finer));
    }

    /// What a geometry needs whose fluid is not meshed at any size: empty if that is not the geometry's fault.
    std::string remedy(const Scene &scene, const ComputationError &error)
    {
      const Clearance clearance = scene.domain ? swimmer_clearance(scene) : Clearance{};
      const bool      is_narrow = scene.domain && clearance.distance_m <= scene.numerics.mesh_size_m;
      if (!is_narrow && !failed_for_the_place(error))
        return {};
      return fmt::format("widen {}, blunt the corner, or lower mesh_growth and mesh_size_far_m",
                         is_narrow ? gap_in_words(clearance) : "the gap there");
    }

    [[noreturn]] void refuse_surfaces(const Scene &scene, const ComputationError &error)
    {
      std::vector<std::string> files;
      for (const auto &surface : {scene.head.surface, scene.domain->surface})
        if (surface)
          files.push_back(surface->file.string());
      throw InputError(fmt::format(
          "{}: the fluid cannot be meshed with the triangles of {} ({}); mesh the surface anew, finer where it "
          "is curved or close to another, and without slivers",
          scene.name, fmt::join(files, " and "), error.what()));
    }

    template <int dim>
    FluidMesh<dim> make_mesh_or_advise(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                       const bool by_halves, const MPI_Comm communicator)
    {
      try
      {
        return make_mesh(swimmer, configuration, by_halves, communicator);
      }
      catch (const OutOfMemory &)
      {
        throw;
      }
      catch (const ComputationError &error)
      {
        if (!is_at_rest(swimmer, configuration))
          say_remedy(error, swimmer.scene());
        if (swimmer.scene().has_surfaces())
          refuse_surfaces(swimmer.scene(), error);
        const auto is_meshed = [&](const Scene &finer) {
          const Swimmer<dim>   body(finer, communicator);
          const FluidMesh<dim> mesh = make_mesh(body, body.configuration_at_rest(), by_halves, communicator);
          return worst_quality<dim>(mesh.mesh, mesh.mesh.nodes) >= finer.numerics.remesh_quality;
        };
        refuse_mesh_size(swimmer.scene(), error, {is_meshed, expected_cells, remedy(swimmer.scene(), error)});
      }
    }
  } // namespace

  bool failed_for_the_place(const ComputationError &error)
  {
    return dynamic_cast<const InvertedElement *>(&error) != nullptr ||
           dynamic_cast<const CrossedSurfaces *>(&error) != nullptr;
  }

  template <int dim>
  FluidMesh<dim> mesh_around(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                             const MPI_Comm communicator)
  {
    return make_mesh_or_advise(swimmer, configuration, solves_half(swimmer.scene()), communicator);
  }

  template FluidMesh<2> mesh_around<2>(const Swimmer<2> &, const Configuration<2> &, MPI_Comm);
  template FluidMesh<3> mesh_around<3>(const Swimmer<3> &, const Configuration<3> &, MPI_Comm);

  template <int dim>
  FluidMesh<dim> mesh_for_given_motions(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                        const MPI_Comm communicator)
  {
    return make_mesh_or_advise(swimmer, configuration, dim == 3 && solves_half(swimmer.scene()), communicator);
  }

  template FluidMesh<2> mesh_for_given_motions<2>(const Swimmer<2> &, const Configuration<2> &, MPI_Comm);
  template FluidMesh<3> mesh_for_given_motions<3>(const Swimmer<3> &, const Configuration<3> &, MPI_Comm);
} // namespace swimtwin
