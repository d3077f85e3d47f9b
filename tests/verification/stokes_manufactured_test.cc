// Stokes flow with a known solution between two circles or spheres, on curved quadratic elements.
#include <fom/body/mesh_around.h>
#include <fom/fluid/stokes.h>
#include <fom/unknowns/condensation.h>
#include <tests/fom/shipped_scene.h>
#include <tests/observed_order.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// u = curl (0, 0, sin(ax) cos(by) cos(cz)), so that Laplace u = -(a^2 + b^2 + c^2) u; in the plane without z.
    template <int dim>
    struct SmoothFlow
    {
      static constexpr double mu = 0.7, pressure_scale = 2., a = 1., b = 1.4, c = dim == 2 ? 0. : 0.8;

      static Tensor<1, dim> velocity(const Point<dim> &x)
      {
        const double   along_z = std::cos(c * x[dim - 1]); // 1 in the plane
        Tensor<1, dim> u;
        u[0] = -b * std::sin(a * x[0]) * std::sin(b * x[1]) * along_z;
        u[1] = -a * std::cos(a * x[0]) * std::cos(b * x[1]) * along_z;
        return u;
      }
      static double         pressure(const Point<dim> &x) { return std::cos(a * x[0]) * std::sin(b * x[1]); }
      static Tensor<1, dim> body_force(const Point<dim> &x)
      {
        Tensor<1, dim> f = mu * (a * a + b * b + c * c) * velocity(x);
        f[0] -= a * std::sin(a * x[0]) * std::sin(b * x[1]);
        f[1] += b * std::cos(a * x[0]) * std::cos(b * x[1]);
        return f;
      }
    };

    /// Radii 1 and 2.5, elements of equal size.
    template <int dim>
    Scene concentric(const double h)
    {
      const std::string shape = dim == 2 ? "disc" : "sphere";
      const std::string scene = "dimension = " + std::to_string(dim) + R"(
fluid = { density_kg_m3 = 1000.0, viscosity_Pa_s = 1.0, inertia = "none" }
domain = { shape = ")" + shape + R"(", radius_m = 2.5 }
head = { shape = ")" + shape + R"(", diameter_m = 2.0, density_kg_m3 = 1000.0 }
time = { duration_s = 1.0, steps = 1 }
)";
      return parse_scene(scene, "concentric",
                         {override_entry("numerics.mesh_size_m", h), override_entry("numerics.mesh_size_corner_m", h),
                          override_entry("numerics.mesh_size_far_m", h), override_entry("numerics.mesh_growth", 1.)});
    }

    struct StokesErrors
    {
      double velocity = 0., pressure = 0., cell_size = 0.;
    };

    /// Solve with velocities given on both boundaries and one pressure.
    template <int dim>
    class ManufacturedFlow
    {
    public:
      using Flow = SmoothFlow<dim>;

      explicit ManufacturedFlow(const double h)
          : scene_(concentric<dim>(h)), swimmer_(scene_, MPI_COMM_WORLD),
            fluid_(scene_, mesh_around(swimmer_, swimmer_.configuration_at_rest(), MPI_COMM_WORLD),
                   swimmer_.pose_at_rest()),
            map_(fluid_.n_rows(), 0, 1.)
      {
        impose_exact_solution();
        solve();
      }

      /// L2 norms over the curved mesh; the pressure's up to a constant.
      StokesErrors errors() const
      {
        double                 velocity = 0., pressure = 0., mean = 0., volume = 0.;
        IsoparametricCell<dim> cell(4);
        for (const auto &nodes : fluid_.mesh().cells)
        {
          const auto x = cell_positions<dim>(nodes, fluid_.mesh().nodes);
          cell.reinit(x);
          for (unsigned int q = 0; q < cell.n_points(); ++q)
          {
            Tensor<1, dim> du = -Flow::velocity(cell.position(q, x));
            double         dp = -Flow::pressure(cell.position(q, x));
            for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
              for (int c = 0; c < dim; ++c)
                du[c] += cell.value(q, a) * values_[fluid_.numbering().vector_index(nodes[a], c)];
            for (int v = 0; v <= dim; ++v)
              dp +=
                  Flow::pressure_scale * cell.linear_value(q, v) * values_[fluid_.numbering().pressure_index(nodes[v])];
            volume += cell.weight(q);
            velocity += cell.weight(q) * du.norm_square();
            pressure += cell.weight(q) * dp * dp;
            mean += cell.weight(q) * dp;
          }
        }
        return {std::sqrt(velocity), std::sqrt(pressure - mean * mean / volume),
                std::pow(volume / fluid_.mesh().n_cells(), 1. / dim)};
      }

      unsigned int n_unknowns() const { return map_.n_unknowns(); }

    private:
      void impose_exact_solution()
      {
        fluid_.describe(map_, true);
        std::vector<unsigned int> boundary = fluid_.fluid_mesh().surface_nodes;
        for (const auto node : boundary)
          for (int c = 0; c < dim; ++c)
            map_.impose(fluid_.numbering().vector_index(node, c));
        map_.close(std::vector<unsigned int>(map_.n_rows(), 0), false, MPI_COMM_WORLD);
        for (const auto &wall_node : fluid_.fluid_mesh().wall_nodes)
          boundary.push_back(wall_node.node);
        for (const auto node : boundary)
          for (int c = 0; c < dim; ++c)
            map_.imposed[fluid_.numbering().vector_index(node, c)] = Flow::velocity(fluid_.mesh().nodes[node])[c];
      }

      void solve()
      {
        const auto         &mesh = fluid_.mesh();
        Condensation<dim>   condensation(map_);
        LinearSolverOptions options;
        options.tolerance = 1e-12;
        LinearSystem system(MPI_COMM_WORLD, options);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          condensation.add_cell(fluid_.cell_rows(c));
        condensation.lay_out(system);
        condensation.reset();
        IsoparametricCell<dim> cell(4);
        FluidCellMatrix<dim>   K;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const auto x = cell_positions<dim>(mesh.cells[c], mesh.nodes);
          cell.reinit(x);
          stokes_cell_matrix<dim>(cell, Flow::mu, Flow::pressure_scale, K);
          std::array<double, n_fluid_cell_dofs<dim>> load{};
          for (unsigned int q = 0; q < cell.n_points(); ++q)
          {
            const auto f = Flow::body_force(cell.position(q, x));
            for (unsigned int i = 0; i < n_cell_nodes<dim> * dim; ++i)
              load[i] += cell.weight(q) * f[i % dim] * cell.value(q, i / dim);
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
      Swimmer<dim>        swimmer_;
      FluidDomain<dim>    fluid_;
      MotionMap<dim>      map_;
      std::vector<double> values_;
    };

    /// Taylor-Hood theory on isoparametric quadratics: orders 3 for the velocity and 2 for the pressure in L2.
    template <int dim>
    void expect_orders(const std::vector<double> &mesh_sizes)
    {
      std::vector<StokesErrors> errors;
      for (const double h : mesh_sizes)
      {
        const ManufacturedFlow<dim> flow(h);
        errors.push_back(flow.errors());
        std::cout << "manufactured flow, " << dim << "D: " << flow.n_unknowns() << " unknowns, cell size "
                  << errors.back().cell_size << ", L2 errors: velocity " << errors.back().velocity << ", pressure "
                  << errors.back().pressure << std::endl;
      }
      const double ratio = errors.front().cell_size / errors.back().cell_size;
      const double u     = observed_order(errors.front().velocity, errors.back().velocity, ratio),
                   p     = observed_order(errors.front().pressure, errors.back().pressure, ratio);
      std::cout << "orders: velocity " << u << ", pressure " << p << std::endl;
      EXPECT_GE(u, 2.9);
      EXPECT_GE(p, 1.9);
    }
  } // namespace

  TEST(StokesManufactured, ConvergesWithTheOrdersOfTaylorHoodInThePlane)
  {
    expect_orders<2>({0.3, 0.15, 0.075});
  }

  TEST(StokesManufactured, ConvergesWithTheOrdersOfTaylorHoodInSpace)
  {
    expect_orders<3>({0.8, 0.4, 0.28});
  }
} // namespace swimtwin
