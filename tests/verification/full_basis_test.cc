// The motion map with all of the tail's nodes as modes: the reduced swimmer's equation is the full-order step.
#include <fom/resistance/motion_resistance.h>
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    struct TailDof
    {
      unsigned int node;
      int          component;
    };

    std::vector<TailDof> free_dofs(const Swimmer<2> &swimmer)
    {
      std::vector<TailDof> dofs;
      for (unsigned int a = 0; a < swimmer.tail().mesh.n_nodes(); ++a)
        if (!swimmer.is_clamped(a))
          for (int c = 0; c < 2; ++c)
            dofs.push_back({a, c});
      return dofs;
    }

    /// Internal forces of the tail in the head's frame, and their derivative, by node and component.
    void tail_forces(const Swimmer<2> &swimmer, const NodalField<2> &shape, Vector<double> &force,
                     FullMatrix<double> &tangent)
    {
      const auto                 &mesh = swimmer.tail().mesh;
      ElasticTail<2>::CellForce   f;
      ElasticTail<2>::CellTangent k;
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        swimmer.elasticity().cell_force_and_tangent(cell, shape, f, k);
        for (unsigned int a = 0; a < f.size(); ++a)
        {
          const auto row = 2 * mesh.cells[cell][a / 2] + a % 2;
          force(row) += f[a];
          for (unsigned int b = 0; b < f.size(); ++b)
            tangent(row, 2 * mesh.cells[cell][b / 2] + b % 2) += k[a][b];
        }
      }
    }
  } // namespace

  // viscosity R xi = (0, torque, -dW/dq) must hold at the end of a full-order step. What is left of it, turned into
  // velocities by the step's own linearisation, is the difference between both steps.
  TEST(FullBasis, ReducedStepIsTheFullOrderStep)
  {
    const Scene scene =
        shipped_scene("reference-2d-casefile",
                      {"numerics.mesh_size_m=8e-4", "numerics.mesh_size_corner_m=3e-4", "numerics.mesh_size_far_m=5e-3",
                       "numerics.mesh_growth=0.6", "numerics.linear_tolerance=1e-12",
                       "numerics.coupling_tolerance=1e-11", "time.steps_per_period=40", "fluid.inertia=none"});
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    for (int step = 0; step < 6; ++step)
      model.advance();
    const auto &swimmer       = model.swimmer();
    const auto &configuration = model.now().configuration;
    const auto &rates         = model.now().rates;
    const auto  dofs          = free_dofs(swimmer);

    std::vector<NodalField<2>> modes(dofs.size(), NodalField<2>(swimmer.tail().mesh.n_nodes()));
    for (unsigned int j = 0; j < dofs.size(); ++j)
      modes[j][dofs[j].node][dofs[j].component] = 1.;
    const auto R = compute_motion_resistance(swimmer, *model.fluid(), configuration, modes).matrix;

    const unsigned int n = dofs.size() + 3, n_tail = 2 * swimmer.tail().mesh.n_nodes();
    Vector<double>     xi(n), load(n), residual(n), difference(n), force(n_tail);
    FullMatrix<double> tangent(n_tail, n_tail), system = R;
    tail_forces(swimmer, configuration.shape, force, tangent);
    const Tensor<1, 2> U = transpose(configuration.pose.rotation()) * rates.velocity;
    xi(0)                = U[0];
    xi(1)                = U[1];
    xi(2)                = rates.omega[0];
    load(2)              = swimmer.torque_on_head(configuration.pose, model.now().time_s).torque[0];
    const double slope   = 2. / 3. * scene.time.time_step_s();
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const auto row = 2 * dofs[i].node + dofs[i].component;
      xi(3 + i)      = rates.shape_rate[dofs[i].node][dofs[i].component];
      load(3 + i)    = -force(row);
      for (unsigned int j = 0; j < dofs.size(); ++j)
        system(3 + i, 3 + j) += slope * tangent(row, 2 * dofs[j].node + dofs[j].component);
    }
    R.vmult(residual, xi);
    residual -= load;
    system.gauss_jordan();
    system.vmult(difference, residual);

    const double length = scene.body_length_m(), speed = std::abs(xi(2)) * length;
    EXPECT_LT(std::abs(difference(0)) / speed, 1e-8);
    EXPECT_LT(std::abs(difference(1)) / speed, 1e-8);
    EXPECT_LT(std::abs(difference(2)) * length / speed, 1e-8);
    double largest = 0.;
    for (unsigned int i = 3; i < n; ++i)
      largest = std::max(largest, std::abs(difference(i)) / speed);
    EXPECT_LT(largest, 1e-8);
    std::printf("difference of the steps: %.1e of the tail's speed, %u modes\n", largest, n - 3);
  }
} // namespace swimtwin
