// A silicone flap bent by its buoyancy, measured by Hessenthaler et al. (2017): whole scene silicone-flap-3d.
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    /// In mm from the clamp: along the flap at rest, and across.
    struct Place
    {
      double z, Y;
    };

    /// Measured centreline, deformed, root mean square of its own fit 0.34 mm.
    double measured_Y(const double z)
    {
      const double s = z / 57.643;
      return 29.5 * s * (-0.123 + s * (2.468 + s * (-2.300 + s * 0.978)));
    }

    /// Means of the material over slices of the flap at rest.
    std::vector<Place> centreline(const FullOrderModel<3> &model)
    {
      constexpr int                n_slices = 30;
      const Scene                 &scene    = model.swimmer().scene();
      const auto                  &mesh     = model.swimmer().tail().mesh;
      const auto                  &volume   = model.swimmer().elasticity().volume_of_node();
      const auto                   x        = model.swimmer().tail_positions(model.now().configuration);
      const double                 root     = scene.head.size_m[0] / 2;
      std::vector<Place>           line(n_slices, {0., 0.});
      std::array<double, n_slices> volumes{};
      for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      {
        const double s     = (mesh.nodes[a][0] - root) / scene.tail->length_m;
        const int    slice = std::min(static_cast<int>(n_slices * s), n_slices - 1);
        line[slice].z += 1e3 * volume[a] * (x[a][0] - root);
        line[slice].Y += 1e3 * volume[a] * x[a][1];
        volumes[slice] += volume[a];
      }
      for (int i = 0; i < n_slices; ++i)
        line[i] = {line[i].z / volumes[i], line[i].Y / volumes[i]};
      return line;
    }
  } // namespace

  // Far from its equilibrium Newton's method bends and stretches the flap in turn, and a small change between two large
  // ones is no sign that it has converged: each step ends where it does with a far smaller tolerance.
  TEST(SiliconeFlap, EveryStepIsItsEquilibrium)
  {
    const auto ends = [](const char *tolerance, const char *steps = "time.steps=20") {
      const Scene scene = shipped_scene(
          "silicone-flap-3d", {"variant=quick", std::string("numerics.coupling_tolerance=") + tolerance, steps});
      FullOrderModel<3>   model(scene, MPI_COMM_WORLD);
      std::vector<double> heights;
      for (int step = 0; step < 6; ++step)
      {
        model.advance();
        const auto x = model.swimmer().tail_positions(model.now().configuration);
        heights.push_back(x[model.swimmer().tail().axis_at_tip[2]][1] / scene.tail->length_m);
      }
      return heights;
    };
    const auto as_usual = ends("1e-6"), exact = ends("1e-10");
    for (std::size_t i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(as_usual[i], exact[i], 1e-5) << "step " << i + 1;
    EXPECT_NEAR(ends("1e-6", "time.steps=80")[3], exact[0], 1e-5); // shorter steps are no harder
  }

  TEST(SiliconeFlap, BendsAsMeasured)
  {
    const Scene       scene = shipped_scene("silicone-flap-3d", {"variant=quick"});
    FullOrderModel<3> model(scene, MPI_COMM_WORLD);
    for (int step = 0; step < scene.time.n_steps(); ++step)
      model.advance();
    const auto tip = model.swimmer().tail_positions(model.now().configuration)[model.swimmer().tail().axis_at_tip[2]];
    double     squares = 0.;
    int        n       = 0;
    for (const auto &[z, Y] : centreline(model))
    {
      squares += std::pow(Y - measured_Y(z), 2);
      ++n;
    }
    const double off = std::sqrt(squares / n);
    std::cout << "tip at " << 1e3 * tip[1] << " mm, measured 29.50 +- 0.98 mm; centreline off by " << off << " mm rms, "
              << model.n_unknowns() << " unknowns" << std::endl;
    EXPECT_NEAR(1e3 * tip[1], 29.50, 0.98);
    EXPECT_LE(off, 0.5);
  }
} // namespace swimtwin
