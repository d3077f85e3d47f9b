// The scallop theorem: a rigid body in Stokes flow goes nowhere, whatever it is turned by. In the plane and in space.
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// One mesh for all poses, coarse: the theorem holds for the discrete equations too, as position is then a function
    /// of angle through the same moving mesh. Tight tolerances, so that only the time steps err.
    std::vector<std::string> coarse_and_tight(const int steps_per_period)
    {
      return {"numerics.mesh_size_m=4e-4",
              "numerics.mesh_size_corner_m=2e-4",
              "numerics.mesh_size_far_m=4e-3",
              "numerics.mesh_growth=0.5",
              "numerics.remesh_quality=0",
              "numerics.coupling_tolerance=1e-11",
              "numerics.linear_tolerance=1e-12",
              "time.periods=2.2",
              "time.steps_per_period=" + std::to_string(steps_per_period)};
    }

    /// The same for the body as built, without walls in reach.
    std::vector<std::string> coarse_in_space(const int steps_per_period)
    {
      return {"tail.law=rigid",
              "field.frequency_Hz=0.1",
              "numerics.mesh_size_m=1e-3",
              "numerics.mesh_size_corner_m=4e-4",
              "numerics.mesh_growth=1",
              "numerics.remesh_quality=0",
              "numerics.coupling_tolerance=1e-11",
              "numerics.linear_tolerance=1e-12",
              "time.periods=2.2",
              "time.steps_per_period=" + std::to_string(steps_per_period)};
    }

    struct Path
    {
      std::vector<double>   time, angle;
      std::vector<Point<2>> center;
    };

    template <int dim>
    Path swim(const Scene &scene)
    {
      FullOrderModel<dim> model(scene, MPI_COMM_WORLD);
      Path                path;
      const auto          note = [&] {
        const RigidPose<dim> &pose = model.now().configuration.pose;
        path.time.push_back(model.now().time_s);
        path.angle.push_back(pose.heading());
        path.center.emplace_back(pose.center[0], pose.center[1]);
      };
      note();
      for (int step = 0; step < scene.time.n_steps(); ++step)
      {
        model.advance();
        note();
      }
      EXPECT_EQ(model.counts().n_remeshes, 0);
      EXPECT_EQ(model.counts().n_step_halvings, 0);
      return path;
    }

    /// Lagrange weights at s of the nodes 0, 1, ..., 5.
    std::array<double, 6> lagrange_weights(const double s)
    {
      std::array<double, 6> w;
      for (int i = 0; i < 6; ++i)
      {
        w[i] = 1.;
        for (int j = 0; j < 6; ++j)
          if (j != i)
            w[i] *= (s - j) / (i - j);
      }
      return w;
    }

    /// Where the centre is when the head has an angle, at its first crossing of it after `from_s`, by interpolation of
    /// degree five in time.
    Point<2> center_at_angle(const Path &path, const double angle, const double from_s)
    {
      unsigned int i = 0;
      while (path.time.at(i + 3) < from_s + 3. * (path.time[1] - path.time[0]) ||
             (path.angle[i] - angle) * (path.angle[i + 1] - angle) > 0.)
        ++i; // at() throws if the crossing is too near the end
      const auto at = [&](const double s, const auto &values) {
        const auto w   = lagrange_weights(s);
        auto       sum = w[0] * values[i - 2];
        for (int k = 1; k < 6; ++k)
          sum += w[k] * values[i - 2 + k];
        return sum;
      };
      double       low = 2., high = 3.; // crossing lies between nodes 2 and 3
      const double sign = path.angle[i + 1] > path.angle[i] ? 1. : -1.;
      for (int k = 0; k < 50; ++k)
      {
        const double middle                                         = .5 * (low + high);
        (sign * (at(middle, path.angle) - angle) > 0. ? high : low) = middle;
      }
      std::vector<Tensor<1, 2>> centers(path.center.begin(), path.center.end());
      return Point<2>(at(low, centers));
    }

    /// Displacement, in body lengths, between instants of equal head angle of the second period: over the stroke there
    /// and back, and over the swing to either side.
    template <int dim>
    std::array<Tensor<1, 2>, 2> closed_stroke_displacements(const Scene &scene)
    {
      const Path   path   = swim<dim>(scene);
      const double period = scene.time.period_s, length = scene.body_length_m();
      // The field swings as sin(2 pi t): a quarter of a period before and after its extremes the angle is the same.
      const Point<2> up = center_at_angle(path, 0.3, period), down = center_at_angle(path, 0.3, 1.25 * period);
      const Point<2> low_down                  = center_at_angle(path, -0.3, 1.5 * period),
                     low_up                    = center_at_angle(path, -0.3, 1.75 * period);
      const std::array<Tensor<1, 2>, 2> result = {(down - up) / length, (low_up - low_down) / length};
      std::cout << "rigid swimmer, " << scene.time.steps_per_period
                << " steps per period: displacement over closed strokes (" << result[0] << "), (" << result[1]
                << ") body lengths" << std::endl;
      return result;
    }

    double order_of(const Tensor<1, 2> &coarse, const Tensor<1, 2> &fine)
    {
      return std::log2(coarse.norm() / fine.norm());
    }
  } // namespace

  TEST(RigidSwimmer, ReciprocalStrokeLeavesNothingBehind)
  {
    const auto displacements = [](const int n) {
      return closed_stroke_displacements<2>(shipped_scene("rigid-swimmer", coarse_and_tight(n)));
    };
    const auto coarse = displacements(50), shipped = displacements(100), fine = displacements(200);
    for (int k = 0; k < 2; ++k)
    {
      const double order = .5 * order_of(coarse[k], fine[k]);
      const double limit = ((4. * fine[k] - shipped[k]) / 3.).norm();
      std::cout << "rigid swimmer: order " << order << ", limit " << limit << " body lengths" << std::endl;
      EXPECT_LE(shipped[k].norm(), 1e-4);
      EXPECT_GE(order, 2.); // BDF2
      EXPECT_LE(limit, 1e-6);
    }
  }

  TEST(RigidSwimmer, ReciprocalStrokeLeavesNothingBehindInSpace)
  {
    const auto displacements = [](const int n) {
      return closed_stroke_displacements<3>(shipped_scene("open-3d", coarse_in_space(n)));
    };
    const auto coarse = displacements(25), fine = displacements(50);
    for (int k = 0; k < 2; ++k)
    {
      EXPECT_LE(fine[k].norm(), 1e-4);
      EXPECT_GE(order_of(coarse[k], fine[k]), 2.);
    }
  }
} // namespace swimtwin
