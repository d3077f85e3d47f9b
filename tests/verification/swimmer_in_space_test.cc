// The elastic swimmer in three dimensions: laws that its motion has to keep, on meshes much coarser than shipped.
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>
#include <tests/verification/balance_in_space.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    std::vector<std::string> coarse(const std::vector<std::string> &more)
    {
      std::vector<std::string> overrides{"variant=quick"};
      overrides.insert(overrides.end(), more.begin(), more.end());
      return overrides;
    }

    Configuration<3> after(const Scene &scene, const int n_steps)
    {
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      for (int step = 0; step < n_steps; ++step)
        model.advance();
      return model.now().configuration;
    }
  } // namespace

  // Over the fourth step of forty, powers by the trapezoidal rule: magnetic work is dissipated or stored.
  TEST(SwimmerInSpace, PowerBalances)
  {
    for (const char *inertia : {"none", "full"})
    {
      const Scene       scene = shipped_scene("reference-3d-paper", coarse({std::string("fluid.inertia=") + inertia}));
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      for (int step = 0; step < 3; ++step)
        model.advance();
      const auto [work, missing] = advance_and_balance(model, scene.time.time_step_s());
      std::cout << "power balance in space, inertia " << inertia << ": open by " << missing / work << std::endl;
      EXPECT_LE(std::abs(missing), 5e-3 * work);
    }
  }

  // Planar by construction of the half; volume of a tail that a closed fluid does not let change.
  TEST(SwimmerInSpace, KeepsItsVolumeInAClosedBox)
  {
    const Scene scene =
        shipped_scene("reference-3d-paper", coarse({"domain.walls={left=\"no-slip\", right=\"no-slip\"}"}));
    const Swimmer<3>       swimmer(scene, MPI_COMM_WORLD);
    const Configuration<3> configuration = after(scene, 3);
    const double           at_rest       = swimmer.volume(swimmer.configuration_at_rest());
    EXPECT_NEAR(swimmer.volume(configuration) / at_rest, 1., 1e-6);
  }

  // From rest in a field that sets in. Bending settles within a step or two, so that the order is approached from
  // below: 1.77 from 40, 80 and 160 steps per period, 1.88 from twice as many (docs/verification.md).
  TEST(SwimmerInSpace, IsOfSecondOrderInTime)
  {
    std::vector<Configuration<3>> ends;
    for (const int factor : {1, 2, 4})
      ends.push_back(
          after(shipped_scene("reference-3d-paper",
                              coarse({"time.steps_per_period=" + std::to_string(40 * factor),
                                      "numerics.coupling_tolerance=1e-9", "numerics.linear_tolerance=1e-9"})),
                6 * factor));
    const Scene      scene = shipped_scene("reference-3d-paper", coarse({}));
    const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
    const double     order =
        std::log2(swimmer.relative_change(ends[0], ends[1]) / swimmer.relative_change(ends[1], ends[2]));
    std::cout << "order in time in space: " << order << std::endl;
    EXPECT_GE(order, 1.7);
  }

  // Every new mesh has another error; nothing else may change where the fluid is meshed anew.
  TEST(SwimmerInSpace, MovesAsWellOnNewMeshes)
  {
    const Scene kept = shipped_scene("reference-3d-paper", coarse({})),
                anew = shipped_scene("reference-3d-paper", coarse({"numerics.remesh_every_steps=2"}));
    const Swimmer<3> swimmer(kept, MPI_COMM_WORLD);
    const auto       end        = after(kept, 5);
    const double     difference = swimmer.relative_change(end, after(anew, 5)),
                 way            = swimmer.relative_change(end, swimmer.configuration_at_rest());
    std::cout << "new meshes change " << difference << " of a motion of " << way << " body lengths" << std::endl;
    EXPECT_LE(difference, 0.01 * way);
  }

  TEST(SwimmerInSpace, HalfMovesAsTheWhole)
  {
    const Scene half  = shipped_scene("reference-3d-paper", coarse({})),
                whole = shipped_scene("reference-3d-paper", coarse({"numerics.symmetric_half=\"off\""}));
    const Swimmer<3> swimmer(half, MPI_COMM_WORLD);
    const double     difference = swimmer.relative_change(after(half, 2), after(whole, 2));
    std::cout << "half and whole differ by " << difference << " body lengths" << std::endl;
    EXPECT_LE(difference, 1e-8);
  }

  // Such a tail begins bent, and half and whole have meshes of their own.
  TEST(SwimmerInSpace, HalfOfAPrescribedWaveMovesAsTheWhole)
  {
    const std::vector<std::string> wave{"tail.law=prescribed", "tail.wave={angle_rad=0.5, frequency_Hz=0.5, waves=1}"};
    std::vector<std::string>       off = wave;
    off.push_back("numerics.symmetric_half=\"off\"");
    const Scene half  = shipped_scene("reference-3d-paper", coarse(wave)),
                whole = shipped_scene("reference-3d-paper", coarse(off));
    const Swimmer<3> swimmer(half, MPI_COMM_WORLD);
    const auto       end        = after(half, 3);
    const double     difference = swimmer.relative_change(end, after(whole, 3)),
                 way = swimmer.relative_change(end, FullOrderModel<3>(half, MPI_COMM_WORLD).now().configuration);
    std::cout << "half and whole differ by " << difference << " of a motion of " << way << " body lengths" << std::endl;
    EXPECT_LE(difference, 0.02 * way);
  }

  // Without inertia all forces are then twice as large. Linear solvers end at another residual by round-off.
  TEST(SwimmerInSpace, DoublingViscosityStiffnessAndFieldChangesNothing)
  {
    const Scene once  = shipped_scene("reference-3d-paper", coarse({})),
                twice = shipped_scene("reference-3d-paper",
                                      coarse({"fluid.viscosity_Pa_s=3.04", "tail.young_modulus_Pa=4e5",
                                              "field.bx_T=1e-2", "field.by_T=1e-2"})),
                thick = shipped_scene("reference-3d-paper", coarse({"fluid.viscosity_Pa_s=3.04"}));
    const Swimmer<3> swimmer(once, MPI_COMM_WORLD);
    const auto       end        = after(once, 3);
    const double     difference = swimmer.relative_change(end, after(twice, 3)),
                 way            = swimmer.relative_change(end, swimmer.configuration_at_rest());
    std::cout << "twice all forces change " << difference << " of a motion of " << way << " body lengths" << std::endl;
    EXPECT_LE(difference, 1e-8);
    EXPECT_GE(swimmer.relative_change(end, after(thick, 3)), 0.1 * way);
  }
} // namespace swimtwin
