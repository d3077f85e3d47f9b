// The reference swimmer with a bent tail that bends on, for tests of one linear system.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>
#include <tests/fom/shipped_scene.h>

#include <cmath>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Turned, moving, and its fluid meshed around it.
  struct BentSwimmer
  {
    Scene            scene;
    Swimmer<2>       swimmer{scene, MPI_COMM_WORLD};
    Configuration<2> configuration = bend();
    FluidDomain<2>   fluid{scene,
                         make_fluid_mesh(*scene.domain, swimmer.surface(configuration), swimmer.surface_mesh_size(),
                                           configuration.pose, swimmer.pose_at_rest(), scene.numerics, MPI_COMM_WORLD),
                         configuration.pose};
    Rates<2>         rates{dealii::Tensor<1, 2>({-1e-4, 3e-4}), AngularVelocity<2>({0.2}), bend_on()};

    explicit BentSwimmer(std::vector<std::string> settings = {}) : scene(coarse_scene(std::move(settings))) {}

  private:
    static Scene coarse_scene(std::vector<std::string> settings)
    {
      settings.insert(settings.begin(), "fluid.inertia=none");
      for (const char *size : {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                               "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.5"})
        settings.emplace_back(size);
      return shipped_scene("reference-2d-casefile", settings);
    }

    Configuration<2> bend() const
    {
      Configuration<2> c = swimmer.configuration_at_rest();
      c.pose.angle       = 0.4;
      for (unsigned int a = 0; a < c.shape.size(); ++a)
        if (!swimmer.is_clamped(a))
          c.shape[a][1] = 10. * std::pow(swimmer.tail().mesh.nodes[a][0] - scene.head.size_m[0] / 2, 2);
      return c;
    }

    NodalField<2> bend_on() const
    {
      NodalField<2> rate = configuration.shape;
      for (auto &v : rate)
        v *= 5.;
      return rate;
    }
  };
} // namespace swimtwin
