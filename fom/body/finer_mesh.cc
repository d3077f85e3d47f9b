#include <fom/body/finer_mesh.h>

#include <fom/mesh/inverted_element.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace swimtwin
{
  namespace
  {
    constexpr int n_halvings = 6;

    Scene with_mesh_size(Scene scene, const double size_m)
    {
      scene.numerics.mesh_size_m        = size_m;
      scene.numerics.mesh_size_corner_m = std::min(scene.numerics.mesh_size_corner_m, size_m);
      return scene;
    }

    bool is_good(const Scene &finer, const std::function<bool(const Scene &)> &is_meshed)
    {
      try
      {
        return is_meshed(finer);
      }
      catch (const ComputationError &)
      {
        return false;
      }
      catch (const InputError &)
      {
        return false;
      }
    }

    std::optional<double> largest_good_size(const Scene &scene, const std::function<bool(const Scene &)> &is_meshed)
    {
      double size = scene.numerics.mesh_size_m;
      for (int k = 0; k < n_halvings; ++k)
        if (size /= 2.; is_good(with_mesh_size(scene, size), is_meshed))
          return size;
      return std::nullopt;
    }

    std::string settings(const Scene &scene, const double size_m)
    {
      std::string text = fmt::format("mesh_size_m = {:.3g}", size_m);
      if (scene.numerics.mesh_size_corner_m > size_m)
        text += fmt::format(" and mesh_size_corner_m = {:.3g}", size_m);
      return text;
    }
  } // namespace

  void refuse_mesh_size(const Scene &scene, const ComputationError &error,
                        const std::function<bool(const Scene &)> &is_meshed)
  {
    const double      size = scene.numerics.mesh_size_m;
    const std::string refused =
        fmt::format("{}: [numerics] mesh_size_m = {} m is too coarse: {}", scene.name, size, error.what());
    if (const auto good = largest_good_size(scene, is_meshed))
      throw InputError(fmt::format("{}; set {} (tried)", refused, settings(scene, *good)));
    if (dynamic_cast<const InvertedElement *>(&error) == nullptr)
      throw ComputationError(error);
    throw InputError(fmt::format("{}; no size down to {:.2g} m does (tried): widen the gap there, blunt the corner, or "
                                 "lower mesh_growth and mesh_size_far_m",
                                 refused, size / (1 << n_halvings)));
  }
} // namespace swimtwin
