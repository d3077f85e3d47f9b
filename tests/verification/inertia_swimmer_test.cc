// Laws of the reference swimmer with the inertia of fluid, tail and head, on a mesh as coarse as it gets.
#include <fom/run/simulation.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>
#include <tests/observed_order.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    using Overrides = std::vector<std::string>;

    SimulationResult swim_with_inertia(const Overrides &more)
    {
      Overrides overrides{"fluid.inertia=full",
                          "numerics.mesh_size_m=6e-4",
                          "numerics.mesh_size_corner_m=2e-4",
                          "numerics.mesh_size_far_m=4e-3",
                          "numerics.mesh_growth=0.6",
                          "numerics.coupling_tolerance=1e-9",
                          "numerics.linear_tolerance=1e-10",
                          "time.periods=1"};
      overrides.insert(overrides.end(), more.begin(), more.end());
      const TemporaryFolder folder;
      SimulationOptions     options;
      options.folder = folder.path;
      return simulate(shipped_scene("reference-2d-casefile", overrides), options, MPI_COMM_WORLD);
    }

    /// Where inertia is strong (unsteady group 3), on a mesh that bears it without remeshing.
    SimulationResult swim_in_thin_fluid(const Overrides &more)
    {
      Overrides overrides{"fluid.viscosity_Pa_s=0.15",        "numerics.mesh_size_m=3e-4",
                          "numerics.mesh_size_corner_m=1e-4", "numerics.mesh_size_far_m=2e-3",
                          "numerics.linear_tolerance=1e-7",   "time.steps_per_period=100"};
      overrides.insert(overrides.end(), more.begin(), more.end());
      return swim_with_inertia(overrides);
    }

    /// Largest distances at the instants that two motions have in common: of head and tail's tip (body lengths), and of
    /// the kinetic energies, which all velocities have a part in, relative to their largest.
    struct Difference
    {
      double position = 0., kinetic_energy = 0.;
    };

    Difference difference(const Trajectory &a, const Trajectory &b)
    {
      constexpr double  body_length_m = 8e-3;
      const std::size_t stride        = (b.size() - 1) / (a.size() - 1);
      Difference        largest;
      double            energy_J_m = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        const TrajectoryRow &p = a[i], &q = b[i * stride];
        EXPECT_NEAR(p.time_s, q.time_s, 1e-12);
        largest.position =
            std::max({largest.position, std::hypot(p.head_x_m - q.head_x_m, p.head_y_m - q.head_y_m) / body_length_m,
                      std::hypot(p.tail_tip_x_m - q.tail_tip_x_m, p.tail_tip_y_m - q.tail_tip_y_m) / body_length_m});
        largest.kinetic_energy =
            std::max(largest.kinetic_energy, std::abs(p.kinetic_energy_J_m - q.kinetic_energy_J_m));
        energy_J_m = std::max(energy_J_m, q.kinetic_energy_J_m);
      }
      largest.kinetic_energy /= energy_J_m;
      return largest;
    }
  } // namespace

  // Consecutive differences fall by 4 in the limit. The first ones are allowed the next order, at 12 steps per half
  // swing; tolerances are far below all of them.
  TEST(SwimmerWithInertia, ConvergesAtSecondOrderInTheStep)
  {
    std::vector<SimulationResult> runs;
    for (const int n : {25, 50, 100, 200})
      runs.push_back(swim_with_inertia({"time.steps_per_period=" + std::to_string(n)}));
    std::vector<Difference> differences;
    std::vector<double>     displacement_changes_m;
    for (std::size_t i = 1; i < runs.size(); ++i)
    {
      const RunSummary &coarse = runs[i - 1].summary, &fine = runs[i].summary;
      ASSERT_EQ(fine.n_remeshes + coarse.n_remeshes, 0) << "meshes differ";
      differences.push_back(difference(runs[i - 1].trajectory, runs[i].trajectory));
      displacement_changes_m.push_back(fine.net_displacement_m.value() - coarse.net_displacement_m.value());
      std::cout << "refinement " << i << ": positions change by " << differences.back().position
                << " body lengths, kinetic energy by " << differences.back().kinetic_energy << ", displacement by "
                << displacement_changes_m.back() << " m, power imbalance " << coarse.worst_power_imbalance.value()
                << " to " << fine.worst_power_imbalance.value() << std::endl;
      EXPECT_GE(std::abs(coarse.worst_power_imbalance.value() / fine.worst_power_imbalance.value()), 3.);
    }
    for (std::size_t i = 1; i < differences.size(); ++i)
    {
      const double least_order = i + 1 == differences.size() ? 1.9 : std::log2(3.);
      EXPECT_GE(observed_order(differences[i - 1].position, differences[i].position, 2.), least_order);
      EXPECT_GE(observed_order(differences[i - 1].kinetic_energy, differences[i].kinetic_energy, 2.), least_order);
      EXPECT_GE(observed_order(displacement_changes_m[i - 1], displacement_changes_m[i], 2.), least_order);
    }
    EXPECT_LE(std::abs(runs[2].summary.worst_power_imbalance.value()), 5e-3);
  }

  // Inertia is a regular perturbation: what it changes is of first order in the densities, and without any of them
  // nothing of it is left.
  TEST(SwimmerWithInertia, TendsToTheQuasiStaticOneWithTheDensities)
  {
    const std::string      steps = "time.steps_per_period=50";
    const SimulationResult limit = swim_with_inertia({steps, "fluid.inertia=none"});
    std::vector<double>    differences;
    for (const double share : {1e-1, 1e-2, 1e-3})
    {
      const SimulationResult run = swim_with_inertia({steps, override_entry("fluid.density_kg_m3", share * 1260.),
                                                      override_entry("tail.density_kg_m3", share * 1200.),
                                                      override_entry("head.density_kg_m3", share * 7000.)});
      differences.push_back(difference(limit.trajectory, run.trajectory).position);
      std::cout << "densities times " << share << ": positions off by " << differences.back() << " body lengths"
                << std::endl;
    }
    EXPECT_NEAR(differences[0] / differences[1], 10., .5);
    EXPECT_NEAR(differences[1] / differences[2], 10., .1);
  }

  // Thirty steps that are each off by the tolerance at most: also those of the start, which double and in which the
  // iteration's contraction grows from 1e-4 to 1.
  TEST(SwimmerWithInertia, CouplingIsAsExactAsItsToleranceSays)
  {
    const SimulationResult as_shipped = swim_in_thin_fluid({"numerics.coupling_tolerance=1e-6", "time.periods=0.3"}),
                           converged  = swim_in_thin_fluid({"numerics.coupling_tolerance=1e-9", "time.periods=0.3"});
    const double position             = difference(converged.trajectory, as_shipped.trajectory).position;
    std::cout << "coupling tolerance 1e-6: positions off by " << position << " body lengths" << std::endl;
    EXPECT_LE(position, 3e-5);
  }

  // The meshes differ, and so do their errors: laws of motion and
  // remeshings are as good as each other if what they change is of that size.
  TEST(SwimmerWithInertia, DisplacementDependsNeitherOnMeshMotionNorOnRemeshing)
  {
    const auto swim = [](const std::string &law, const int remesh_every_steps) {
      return swim_in_thin_fluid({"numerics.coupling_tolerance=1e-6", "numerics.mesh_motion=" + law,
                                 "numerics.remesh_every_steps=" + std::to_string(remesh_every_steps)});
    };
    const SimulationResult one_mesh = swim("elastic", 0), many_meshes = swim("elastic", 5),
                           other_law = swim("harmonic", 0);
    EXPECT_EQ(one_mesh.summary.n_remeshes, 0);
    EXPECT_GE(many_meshes.summary.n_remeshes, 20);
    const double displacement_m = one_mesh.summary.net_displacement_m.value();
    for (const auto *run : {&many_meshes, &other_law})
    {
      const double share    = run->summary.net_displacement_m.value() / displacement_m - 1.,
                   position = difference(one_mesh.trajectory, run->trajectory).position;
      std::cout << run->summary.n_remeshes << " remeshings: displacement off by " << share << ", positions by "
                << position << " body lengths, power imbalance " << run->summary.worst_power_imbalance.value()
                << std::endl;
      EXPECT_NEAR(share, 0., 0.01);
      EXPECT_LE(position, 1e-3);
      EXPECT_LE(std::abs(run->summary.worst_power_imbalance.value()), 5e-3);
    }
  }
} // namespace swimtwin
