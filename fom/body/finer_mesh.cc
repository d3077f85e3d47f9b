#include <fom/body/finer_mesh.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr int    n_halvings        = 6;
    constexpr double most_cells_to_try = 5e4; ///< in space; one mesh of them takes some ten seconds

    Scene with_mesh_size(Scene scene, const double size_m)
    {
      scene.numerics.mesh_size_m        = size_m;
      scene.numerics.mesh_size_corner_m = std::min(scene.numerics.mesh_size_corner_m, size_m);
      return scene;
    }

    struct Trials
    {
      double smallest_m; ///< size that was tried; the scene's own if none was
      bool   is_found;   ///< whether it works
    };

    Trials try_smaller_sizes(const Scene &scene, const FinerMesh &mesh)
    {
      double size = scene.numerics.mesh_size_m;
      for (int k = 0; k < n_halvings; ++k)
      {
        const Scene finer = with_mesh_size(scene, size / 2.);
        if (scene.dimension == 3 && mesh.expected_cells(finer) > most_cells_to_try)
          break;
        try
        {
          if (mesh.is_meshed(finer))
            return {size / 2., true};
        }
        catch (const OutOfMemory &)
        {
          break;
        }
        catch (const ComputationError &)
        {
        }
        catch (const InputError &)
        {
        }
        size /= 2.;
      }
      return {size, false};
    }

    std::string settings(const Scene &scene, const double size_m)
    {
      std::string text = fmt::format("mesh_size_m = {:.3g}", size_m);
      if (scene.numerics.mesh_size_corner_m > size_m)
        text += fmt::format(" and mesh_size_corner_m = {:.3g}", size_m);
      return text;
    }
  } // namespace

  void refuse_mesh_size(const Scene &scene, const ComputationError &error, const FinerMesh &mesh)
  {
    const std::string refused   = fmt::format("{}: [numerics] mesh_size_m = {} m is too coarse: {}", scene.name,
                                              scene.numerics.mesh_size_m, error.what());
    const auto [size, is_found] = try_smaller_sizes(scene, mesh);
    if (is_found)
      throw InputError(fmt::format("{}; set {} (tried)", refused, settings(scene, size)));
    if (mesh.remedy.empty())
      throw ComputationError(error);
    const std::string tried = size < scene.numerics.mesh_size_m
                                  ? fmt::format("no size down to {:.2g} m does (tried)", size)
                                  : "smaller ones were not tried, whose meshes would take minutes";
    throw InputError(fmt::format("{}; {}: {}", refused, tried, mesh.remedy));
  }
} // namespace swimtwin
