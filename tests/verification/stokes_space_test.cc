// Stokes flow in space against known solutions, on curved quadratic tetrahedra: a manufactured one between two spheres,
// and what a sphere feels inside a sphere and on the axis of a cylinder.
#include <fom/algebra/condensation.h>
#include <fom/body/mesh_around.h>
#include <fom/fluid/stokes.h>
#include <fom/resistance/resistance.h>
#include <tests/fom/shipped_scene.h>
#include <tests/observed_order.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;
    using std::numbers::pi;

    constexpr auto sphere_in_sphere = R"(
dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
inertia = "none"
[domain]
shape = "sphere"
radius_m = 2.5
[head]
shape = "sphere"
diameter_m = 2.0
density_kg_m3 = 1000.0
[time]
duration_s = 1.0
steps = 1
)";

    constexpr auto sphere_in_cylinder = R"(
dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
inertia = "none"
[domain]
shape = "cylinder"
radius_m = 1.0
length_m = 6.0
walls = { left = "no-slip", right = "no-slip" }
[head]
shape = "sphere"
diameter_m = 1.0
density_kg_m3 = 1000.0
[time]
duration_s = 1.0
steps = 1
)";

    std::vector<std::string> mesh_sizes(const double on_body, const double far, const double growth)
    {
      return {override_entry("numerics.mesh_size_m", on_body), override_entry("numerics.mesh_size_corner_m", on_body),
              override_entry("numerics.mesh_size_far_m", far), override_entry("numerics.mesh_growth", growth)};
    }

    /// u = curl (0, 0, sin(ax) cos(by) cos(cz)), so that Laplace u = -(a^2 + b^2 + c^2) u.
    struct SmoothFlow
    {
      static constexpr double mu = 0.7, pressure_scale = 2., a = 1., b = 1.4, c = 0.8;

      static Tensor<1, 3> velocity(const Point<3> &x)
      {
        return Tensor<1, 3>({-b * std::sin(a * x[0]) * std::sin(b * x[1]) * std::cos(c * x[2]),
                             -a * std::cos(a * x[0]) * std::cos(b * x[1]) * std::cos(c * x[2]), 0.});
      }
      static double       pressure(const Point<3> &x) { return std::cos(a * x[0]) * std::sin(b * x[1]); }
      static Tensor<1, 3> body_force(const Point<3> &x)
      {
        const Tensor<1, 3> gradient(
            {-a * std::sin(a * x[0]) * std::sin(b * x[1]), b * std::cos(a * x[0]) * std::cos(b * x[1]), 0.});
        return mu * (a * a + b * b + c * c) * velocity(x) + gradient;
      }
    };

    struct ErrorsInSpace
    {
      double velocity = 0., pressure = 0., cell_size = 0.;
    };

    /// Solve with velocities given on both spheres and one pressure; L2 errors, the pressure's up to a constant.
    class ManufacturedFlow
    {
    public:
      explicit ManufacturedFlow(const double h)
          : scene_(parse_scene(sphere_in_sphere, "sphere-in-sphere", mesh_sizes(h, h, 1.))),
            swimmer_(scene_, MPI_COMM_WORLD),
            fluid_(scene_, mesh_around(swimmer_, swimmer_.configuration_at_rest(), MPI_COMM_WORLD),
                   swimmer_.pose_at_rest()),
            map_(fluid_.n_rows(), 0, 1.)
      {
        impose_exact_solution();
        solve();
      }

      ErrorsInSpace errors() const
      {
        double               velocity = 0., pressure = 0., mean = 0., volume = 0.;
        const auto          &mesh = fluid_.mesh();
        IsoparametricCell<3> cell(4);
        const auto           pressure_error = [&](const unsigned int q, const CellNodes<3> &nodes, const Point<3> &x) {
          double p = 0.;
          for (int v = 0; v < 4; ++v)
            p += cell.linear_value(q, v) * SmoothFlow::pressure_scale *
                 values_[fluid_.numbering().pressure_index(nodes[v])];
          return p - SmoothFlow::pressure(x);
        };
        for (int pass = 0; pass < 2; ++pass)
          for (const auto &nodes : mesh.cells)
          {
            const auto x = cell_positions<3>(nodes, mesh.nodes);
            cell.reinit(x);
            for (unsigned int q = 0; q < cell.n_points(); ++q)
            {
              const Point<3> p = cell.position(q, x);
              if (pass == 0)
              {
                mean += cell.weight(q) * pressure_error(q, nodes, p);
                volume += cell.weight(q);
                continue;
              }
              Tensor<1, 3> e = -SmoothFlow::velocity(p);
              for (unsigned int a = 0; a < n_cell_nodes<3>; ++a)
                for (int c = 0; c < 3; ++c)
                  e[c] += cell.value(q, a) * values_[fluid_.numbering().vector_index(nodes[a], c)];
              velocity += cell.weight(q) * e.norm_square();
              pressure += cell.weight(q) * std::pow(pressure_error(q, nodes, p) - mean / volume, 2);
            }
          }
        return {std::sqrt(velocity), std::sqrt(pressure), std::cbrt(volume / mesh.n_cells())};
      }

    private:
      void impose_exact_solution()
      {
        fluid_.describe(map_, true);
        std::vector<unsigned int> boundary = fluid_.fluid_mesh().surface_nodes;
        for (const auto node : boundary)
          for (int c = 0; c < 3; ++c)
            map_.impose(fluid_.numbering().vector_index(node, c));
        map_.close(std::vector<unsigned int>(map_.n_rows(), 0), false, MPI_COMM_WORLD);
        for (const auto &wall_node : fluid_.fluid_mesh().wall_nodes)
          boundary.push_back(wall_node.node);
        for (const auto node : boundary)
          for (int c = 0; c < 3; ++c)
            map_.imposed[fluid_.numbering().vector_index(node, c)] = SmoothFlow::velocity(fluid_.mesh().nodes[node])[c];
      }

      void solve()
      {
        const auto         &mesh = fluid_.mesh();
        Condensation<3>     condensation(map_);
        LinearSolverOptions options;
        options.tolerance = 1e-10;
        LinearSystem system(MPI_COMM_WORLD, options);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          condensation.add_cell(fluid_.cell_rows(c));
        condensation.lay_out(system);
        condensation.reset();
        IsoparametricCell<3> cell(4);
        FluidCellMatrix<3>   K;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const auto x = cell_positions<3>(mesh.cells[c], mesh.nodes);
          cell.reinit(x);
          stokes_cell_matrix<3>(cell, SmoothFlow::mu, SmoothFlow::pressure_scale, K);
          std::array<double, n_fluid_cell_dofs<3>> load{};
          for (unsigned int q = 0; q < cell.n_points(); ++q)
          {
            const auto f = SmoothFlow::body_force(cell.position(q, x));
            for (unsigned int i = 0; i < n_cell_nodes<3> * 3; ++i)
              load[i] += cell.weight(q) * f[i % 3] * cell.value(q, i / 3);
          }
          condensation.add(c, K, load);
        }
        system.set_matrix(condensation.values());
        system.set_right_hand_side(condensation.right_hand_side());
        std::vector<double> unknowns(map_.n_unknowns(), 0.);
        ASSERT_TRUE(system.solve(unknowns));
        values_ = map_.expand(unknowns);
      }

      Scene               scene_;
      Swimmer<3>          swimmer_;
      FluidDomain<3>      fluid_;
      MotionMap<3>        map_;
      std::vector<double> values_;
    };

    ResistanceResult<3> resistance(const Scene &scene)
    {
      const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
      return compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
    }
  } // namespace

  TEST(StokesInSpace, ManufacturedFlowHasTheOrdersOfTaylorHood)
  {
    const ErrorsInSpace coarse = ManufacturedFlow(.8).errors(), fine = ManufacturedFlow(.4).errors();
    const double        ratio = coarse.cell_size / fine.cell_size;
    const double        u     = observed_order(coarse.velocity, fine.velocity, ratio),
                 p            = observed_order(coarse.pressure, fine.pressure, ratio);
    std::cout << "manufactured flow in space: orders " << u << " and " << p << ", errors " << fine.velocity << ", "
              << fine.pressure << std::endl;
    EXPECT_GE(u, 2.9);
    EXPECT_GE(p, 1.9);
  }

  // Exact for a = 1, b = 2.5: translation and rotation (Happel and Brenner, Low Reynolds number hydrodynamics).
  TEST(SphereInSphere, DragAndTorqueAreExact)
  {
    const auto   result = resistance(parse_scene(sphere_in_sphere, "sphere-in-sphere", mesh_sizes(.16, .25, .3)));
    const double l      = 1. / 2.5;
    const double drag   = 6. * pi * (1. - std::pow(l, 5)) /
                        (1. - 9. * l / 4. + 5. * std::pow(l, 3) / 2. - 9. * std::pow(l, 5) / 4. + std::pow(l, 6));
    const double torque = 8. * pi / (1. - l * l * l);
    std::cout << "sphere in sphere: " << result.n_unknowns << " unknowns, drag off by "
              << result.matrix(0, 0) / drag - 1. << " and " << result.matrix(1, 1) / drag - 1. << ", torque by "
              << result.matrix(2, 2) / torque - 1. << ", asymmetry " << result.asymmetry << std::endl;
    for (int c = 0; c < 2; ++c)
      EXPECT_NEAR(result.matrix(c, c), drag, 1e-3 * drag);
    EXPECT_NEAR(result.matrix(2, 2), torque, 1e-3 * torque);
    EXPECT_LE(result.asymmetry, 1e-10);
  }

  // W. L. Haberman, R. M. Sayre, David Taylor Model Basin Report 1143, 1958, as quoted: factors of Stokes' drag. Their
  // closed formula is an approximation: at a/R = 0.4 and 0.5 the drag here is 0.3 and 1.4 % above it on every fine
  // mesh.
  TEST(SphereInCylinder, DragIsTheTabulatedOne)
  {
    const std::pair<double, double> table[] = {{.1, 1.2633}, {.2, 1.6797}, {.3, 2.3697}};
    for (const auto &[ratio, factor] : table)
    {
      auto overrides = mesh_sizes(ratio / 6., .2, .4);
      overrides.push_back(override_entry("head.diameter_m", 2. * ratio));
      const auto   result = resistance(parse_scene(sphere_in_cylinder, "sphere-in-cylinder", overrides));
      const double stokes = 6. * pi * ratio;
      std::cout << "sphere in cylinder, a/R = " << ratio << ": " << result.n_unknowns << " unknowns, drag off by "
                << result.matrix(0, 0) / (factor * stokes) - 1. << std::endl;
      EXPECT_NEAR(result.matrix(0, 0), factor * stokes, 5e-3 * factor * stokes);
    }
  }
} // namespace swimtwin
