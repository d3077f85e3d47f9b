// Stokes flow with a known solution between two circles, on curved quadratic triangles.
#include <fom/algebra/condensation.h>
#include <fom/fluid/stokes.h>
#include <fom/mesh/fluid_mesh.h>
#include <fom/mesh/swimmer_outline.h>
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

    constexpr double mu = 0.7, pressure_scale = 2., alpha = 2., beta = 3.;

    /// u = (d/dy, -d/dx) sin(alpha x) cos(beta y), so that Laplace u = -(alpha^2 + beta^2) u.
    Tensor<1, 2> exact_velocity(const Point<2> &x)
    {
      return Tensor<1, 2>({-beta * std::sin(alpha * x[0]) * std::sin(beta * x[1]),
                           -alpha * std::cos(alpha * x[0]) * std::cos(beta * x[1])});
    }
    double exact_pressure(const Point<2> &x)
    {
      return std::cos(alpha * x[0]) * std::sin(beta * x[1]);
    }
    Tensor<1, 2> body_force(const Point<2> &x)
    {
      const Tensor<1, 2> pressure_gradient({-alpha * std::sin(alpha * x[0]) * std::sin(beta * x[1]),
                                            beta * std::cos(alpha * x[0]) * std::cos(beta * x[1])});
      return mu * (alpha * alpha + beta * beta) * exact_velocity(x) + pressure_gradient;
    }

    /// Between circles of radius 0.4 m and 1 m, elements of equal size.
    FluidMesh<2> annulus(const double h)
    {
      static Scene scene =
          shipped_scene("rotating-disc", {"head.diameter_m=0.8", "domain.radius_m=1.0", "numerics.mesh_size_far_m=0.1",
                                          "numerics.mesh_size_m=0.1", "numerics.mesh_size_corner_m=0.1"});
      scene.numerics.mesh_size_m = scene.numerics.mesh_size_corner_m = scene.numerics.mesh_size_far_m = h;
      const auto surface = make_outline(scene.head, {}, scene.numerics).surface();
      return make_fluid_mesh(*scene.domain, surface, std::vector<double>(surface.size() / 2, h), {}, {}, scene.numerics,
                             MPI_COMM_WORLD);
    }

    struct StokesErrors
    {
      double velocity = 0., pressure = 0., cell_size = 0.;
    };

    std::vector<unsigned int> cell_rows(const CellNodes<2> &nodes, const NodeNumbering<2> &numbering)
    {
      std::vector<unsigned int> rows;
      for (const auto node : nodes)
        for (int c = 0; c < 2; ++c)
          rows.push_back(numbering.vector_index(node, c));
      for (int v = 0; v < 3; ++v)
        rows.push_back(numbering.pressure_index(nodes[v]));
      return rows;
    }

    /// Velocities given on both circles, one pressure at a vertex.
    void impose_exact_solution(const FluidMesh<2> &fluid, const NodeNumbering<2> &numbering, MotionMap<2> &map)
    {
      std::vector<unsigned int> boundary = fluid.surface_nodes;
      for (const auto &wall_node : fluid.wall_nodes)
        boundary.push_back(wall_node.node);
      for (const auto node : boundary)
        for (int c = 0; c < 2; ++c)
        {
          map.impose(numbering.vector_index(node, c));
          map.imposed[numbering.vector_index(node, c)] = exact_velocity(fluid.mesh.nodes[node])[c];
        }
      map.impose(numbering.pressure_index(0));
      map.close(std::vector<unsigned int>(numbering.size(), 0), false, MPI_COMM_WORLD);
    }

    std::vector<double> solve(const FluidMesh<2> &fluid, const NodeNumbering<2> &numbering)
    {
      MotionMap<2> map(numbering.size(), 0, 1.);
      impose_exact_solution(fluid, numbering, map);
      Condensation<2>     condensation(map);
      LinearSolverOptions options;
      options.tolerance = 1e-12;
      LinearSystem system(MPI_COMM_WORLD, options);
      for (const auto &nodes : fluid.mesh.cells)
        condensation.add_cell(cell_rows(nodes, numbering));
      condensation.lay_out(system);
      condensation.reset();

      IsoparametricCell<2> cell(4);
      FluidCellMatrix<2>   K;
      for (unsigned int c = 0; c < fluid.mesh.n_cells(); ++c)
      {
        const auto x = cell_positions<2>(fluid.mesh.cells[c], fluid.mesh.nodes);
        cell.reinit(x);
        stokes_cell_matrix<2>(cell, mu, pressure_scale, K);
        std::array<double, n_fluid_cell_dofs<2>> load{};
        for (unsigned int q = 0; q < cell.n_points(); ++q)
        {
          const auto f = body_force(cell.position(q, x));
          for (unsigned int i = 0; i < n_cell_nodes<2> * 2; ++i)
            load[i] += cell.weight(q) * f[i % 2] * cell.value(q, i / 2);
        }
        condensation.add(c, K, load);
      }
      system.set_matrix(condensation.values());
      system.set_right_hand_side(condensation.right_hand_side());
      std::vector<double> unknowns(map.n_unknowns(), 0.);
      EXPECT_TRUE(system.solve(unknowns));
      return map.expand(unknowns);
    }

    /// L2 norms over the curved mesh; the pressure's up to a constant.
    StokesErrors measure(const FluidMesh<2> &fluid, const NodeNumbering<2> &numbering,
                         const std::vector<double> &values)
    {
      IsoparametricCell<2> cell(4);
      double               area = 0., velocity = 0., pressure = 0., pressure_mean = 0.;
      for (const auto &nodes : fluid.mesh.cells)
      {
        const auto x = cell_positions<2>(nodes, fluid.mesh.nodes);
        cell.reinit(x);
        for (unsigned int q = 0; q < cell.n_points(); ++q)
        {
          Tensor<1, 2> du = -exact_velocity(cell.position(q, x));
          double       dp = -exact_pressure(cell.position(q, x));
          for (unsigned int a = 0; a < n_cell_nodes<2>; ++a)
            for (int c = 0; c < 2; ++c)
              du[c] += cell.value(q, a) * values[numbering.vector_index(nodes[a], c)];
          for (unsigned int v = 0; v < 3; ++v)
            dp += pressure_scale * cell.linear_value(q, v) * values[numbering.pressure_index(nodes[v])];
          area += cell.weight(q);
          velocity += cell.weight(q) * du.norm_square();
          pressure += cell.weight(q) * dp * dp;
          pressure_mean += cell.weight(q) * dp;
        }
      }
      return {std::sqrt(velocity), std::sqrt(pressure - pressure_mean * pressure_mean / area),
              std::sqrt(area / fluid.mesh.n_cells())};
    }
  } // namespace

  // Taylor-Hood theory on isoparametric quadratics: orders 3 for the velocity and 2 for the pressure in L2.
  TEST(StokesManufactured, VelocityConvergesWithOrderThreeAndPressureWithOrderTwo)
  {
    std::vector<StokesErrors> errors;
    for (const double h : {0.12, 0.06, 0.03})
    {
      const FluidMesh<2>     fluid = annulus(h);
      const NodeNumbering<2> numbering(fluid.mesh, true);
      errors.push_back(measure(fluid, numbering, solve(fluid, numbering)));
      const auto &e = errors.back();
      std::cout << "manufactured Stokes: " << numbering.size() << " values, cell size " << e.cell_size
                << ", L2 errors: velocity " << e.velocity << ", pressure " << e.pressure << std::endl;
    }
    const double ratio          = errors[0].cell_size / errors[2].cell_size;
    const double velocity_order = observed_order(errors[0].velocity, errors[2].velocity, ratio),
                 pressure_order = observed_order(errors[0].pressure, errors[2].pressure, ratio);
    std::cout << "manufactured Stokes: orders: velocity " << velocity_order << ", pressure " << pressure_order
              << std::endl;
    EXPECT_GE(velocity_order, 2.9);
    EXPECT_GE(pressure_order, 1.9);
  }
} // namespace swimtwin
