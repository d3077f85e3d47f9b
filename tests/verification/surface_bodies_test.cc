// Bodies and walls that are read from surfaces against exact solutions, laws, and the same as known shapes.
#include <datasets/surface/closed_surface.h>
#include <fom/body/mesh_around.h>
#include <fom/fluid/fluid_domain.h>
#include <fom/resistance/resistance.h>
#include <tests/datasets/example_surfaces.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;

    constexpr auto body_in_sphere = R"(
dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
inertia = "none"
[domain]
shape = "sphere"
radius_m = 2.5
[head]
shape = "surface"
surface = "surface.msh"
surface_unit_m = 1.0
motion = "fixed"
[time]
duration_s = 1.0
steps = 1
[numerics]
mesh_size_far_m = 0.8
mesh_growth = 0.4
)";

    constexpr auto sphere_in_box = R"(
dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
inertia = "none"
[domain]
shape = "box"
size_m = [4.0, 3.0, 3.0]
[head]
shape = "sphere"
diameter_m = 1.0
density_kg_m3 = 1000.0
[time]
duration_s = 1.0
steps = 1
[numerics]
mesh_size_m = 0.2
mesh_size_corner_m = 0.2
mesh_size_far_m = 0.5
mesh_growth = 0.4
)";

    ResistanceResult<3> resistance_of_surface(const Scene &scene)
    {
      const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
      return compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
    }

    Scene scene_with(const std::string &text, const ExampleSurface &surface,
                     const std::vector<std::string> &overrides = {})
    {
      const TemporaryFolder folder;
      folder.write("surface.msh", msh_text(surface));
      return parse_scene(text, (folder.path / "scene.toml").string(), overrides);
    }

    double volume_of_mesh(const Scene &scene)
    {
      const Swimmer<3>     swimmer(scene, MPI_COMM_WORLD);
      const auto           rest = swimmer.configuration_at_rest();
      const FluidMesh<3>   mesh = mesh_around(swimmer, rest, MPI_COMM_WORLD);
      IsoparametricCell<3> map;
      double               volume = 0.;
      for (const auto &cell : mesh.mesh.cells)
      {
        map.reinit(cell_positions<3>(cell, mesh.mesh.nodes));
        for (unsigned int q = 0; q < map.n_points(); ++q)
          volume += map.weight(q);
      }
      return volume;
    }

    /// Of a sphere of radius 1 in one of 2.5 (Happel and Brenner, Low Reynolds number hydrodynamics).
    constexpr double l          = 1. / 2.5;
    const double     exact_drag = 6. * pi * (1. - std::pow(l, 5)) /
                              (1. - 9. * l / 4. + 5. * std::pow(l, 3) / 2. - 9. * std::pow(l, 5) / 4. + std::pow(l, 6));
    const double exact_torque = 8. * pi / (1. - l * l * l);

    /// Largest errors of drag and torque over the three directions; all elements are `factor` times smaller.
    std::array<double, 2> errors_of_sphere(const int n, const bool is_curved, const double factor = 1.)
    {
      const auto result = resistance_of_surface(scene_with(body_in_sphere, example_sphere(n, 1., is_curved),
                                                           {override_entry("numerics.mesh_size_far_m", .8 / factor),
                                                            override_entry("numerics.mesh_growth", .4 / factor)}));
      double     drag = 0., torque = 0.;
      for (int c = 0; c < 3; ++c)
      {
        drag   = std::max(drag, std::abs(result.matrix(c, c) / exact_drag - 1.));
        torque = std::max(torque, std::abs(result.matrix(3 + c, 3 + c) / exact_torque - 1.));
      }
      std::cout << 20 * (1 << (2 * n)) << (is_curved ? " curved" : " straight") << " triangles, " << result.n_unknowns
                << " unknowns: drag off by " << drag << ", torque by " << torque << std::endl;
      EXPECT_LT(result.asymmetry, 1e-10);
      return {drag, torque};
    }
  } // namespace

  TEST(SurfaceBody, SphereOfCurvedTrianglesConvergesToTheExactResistance)
  {
    const auto coarse = errors_of_sphere(1, true), fine = errors_of_sphere(2, true, 2.);
    for (int i = 0; i < 2; ++i)
    {
      EXPECT_LT(coarse[i], .03);
      EXPECT_LT(fine[i], coarse[i] / 4.); // of second order at least on meshes as coarse as these
    }
  }

  // A sphere in which all corners lie is as much smaller as its volume is.
  TEST(SurfaceBody, SphereOfStraightTrianglesIsOffByItsGeometry)
  {
    const Scene  scene  = scene_with(body_in_sphere, example_sphere(2, 1., false));
    const double radius = std::cbrt(scene.head.volume(3) * 3. / (4. * pi));
    const auto   error  = errors_of_sphere(2, false);
    EXPECT_LT(radius, .99);
    EXPECT_LT(error[0],
              2.5 * 1.9 * (1. - radius)); // drag goes with l at least, near a wall more: d ln F / d ln l = 1.9
  }

  TEST(SurfaceBody, MeshFillsWhatIsBetweenTheSurfaces)
  {
    const Scene scene =
        scene_with(body_in_sphere, example_sphere(1, 1., true), {"domain={shape=\"box\", size_m=[4.0, 5.0, 6.0]}"});
    EXPECT_NEAR(volume_of_mesh(scene), 120. - scene.head.volume(3), 1e-10);
  }

  // R'_UU = s Q R_UU Q^T, R'_UO = s^2 Q R_UO Q^T, R'_OO = s^3 Q R_OO Q^T, in a domain s times as large.
  TEST(SurfaceBody, TurnedAndScaledHasTheTurnedAndScaledResistance)
  {
    ExampleSurface body = example_sphere(2, 1., true);
    for (auto &x : body.points)
    {
      x[0] *= 1.5;
      x[1] *= .7 + .1 * x[0]; // no centre, no plane of symmetry
      x[2] = .8 * x[2] + .2 * x[1];
    }
    ExampleSurface                   turned = body;
    const double                     s = 2., c = std::cos(.7), w = std::sin(.7);
    const dealii::FullMatrix<double> Q = [&] {
      dealii::FullMatrix<double> q(3, 3); // about z, then about x
      const double               a[3][3] = {{c, -w, 0.}, {w * c, c * c, -w}, {w * w, c * w, c}};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          q(i, j) = a[i][j];
      return q;
    }();
    for (std::size_t p = 0; p < body.points.size(); ++p)
      for (int i = 0; i < 3; ++i)
      {
        turned.points[p][i] = 0.;
        for (int j = 0; j < 3; ++j)
          turned.points[p][i] += s * Q(i, j) * body.points[p][j];
      }
    const auto at_first  = resistance_of_surface(scene_with(body_in_sphere, body)).matrix,
               as_turned = resistance_of_surface(scene_with(body_in_sphere, turned,
                                                            {"domain.radius_m=5.0", "numerics.mesh_size_far_m=1.6"}))
                               .matrix;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
      {
        double expected = 0.;
        for (int k = 0; k < 3; ++k)
          for (int m = 0; m < 3; ++m)
            expected += Q(i % 3, k) * at_first(i - i % 3 + k, j - j % 3 + m) * Q(j % 3, m);
        expected *= std::pow(s, 1 + i / 3 + j / 3);
        EXPECT_NEAR(as_turned(i, j), expected, .005 * std::sqrt(as_turned(i, i) * as_turned(j, j))) << i << ' ' << j;
      }
  }

  TEST(SurfaceWalls, BoxFromASurfaceIsTheBox)
  {
    const auto        known = resistance_of_surface(parse_scene(sphere_in_box, "box.toml"));
    const std::string walls = "domain={shape=\"surface\", surface=\"surface.msh\", surface_unit_m=1.0}";
    const Scene       scene = scene_with(sphere_in_box, example_box({4., 3., 3.}, 6), {walls});
    const auto        read  = resistance_of_surface(scene);
    ASSERT_EQ(read.matrix.m(), 6u);
    const int place[3] = {0, 1, 5}; // of what the half knows
    for (int i = 0; i < 3; ++i)
    {
      std::cout << "box as a surface against the box: " << read.matrix(place[i], place[i]) / known.matrix(i, i) - 1.
                << std::endl;
      EXPECT_NEAR(read.matrix(place[i], place[i]) / known.matrix(i, i), 1., .005);
    }
    EXPECT_NEAR(read.matrix(2, 2) / read.matrix(1, 1), 1., .005);
    EXPECT_NEAR(volume_of_mesh(scene), 36. - pi / 6., 1e-3); // of a sphere made of quadratic triangles
  }
} // namespace swimtwin
