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
      double      smallest_m;          ///< size that was tried; the scene's own if none was
      bool        is_found    = false; ///< whether it works
      const char *why_no_more = "";    ///< empty if all were tried
    };

    Trials try_smaller_sizes(const Scene &scene, const FinerMesh &mesh)
    {
      double size = scene.numerics.mesh_size_m;
      for (int k = 0; k < n_halvings; ++k)
      {
        const Scene finer = with_mesh_size(scene, size / 2.);
        if (scene.dimension == 3 && mesh.expected_cells(finer) > most_cells_to_try)
          return {size, false, "smaller ones were not tried, whose meshes would take minutes"};
        try
        {
          if (mesh.is_meshed(finer))
            return {size / 2., true};
        }
        catch (const OutOfMemory &)
        {
          return {size, false, "for half of it memory does not suffice"};
        }
        catch (const ComputationError &)
        {
        }
        catch (const InputError &)
        {
        }
        size /= 2.;
      }
      return {size};
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
    const std::string refused = fmt::format("{}: [numerics] mesh_size_m = {} m is too coarse: {}", scene.name,
                                            scene.numerics.mesh_size_m, error.what());
    const auto [size, is_found, why_no_more] = try_smaller_sizes(scene, mesh);
    if (is_found)
      throw InputError(fmt::format("{}; set {} (tried)", refused, settings(scene, size)));
    if (mesh.remedy.empty())
      throw ComputationError(error);
    const std::string tried =
        size < scene.numerics.mesh_size_m ? fmt::format("no size down to {:.2g} m does (tried)", size) : why_no_more;
    throw InputError(fmt::format("{}; {}: {}", refused, tried, mesh.remedy));
  }
} // namespace swimtwin
