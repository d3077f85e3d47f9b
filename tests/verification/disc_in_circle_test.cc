// A disc of radius a in a concentric no-slip circle of radius b: the torque and the drag are known exactly.
#include <fom/resistance/resistance.h>
#include <fom/step/full_order_model.h>
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
    using std::numbers::pi;

    constexpr double a = 1e-3, b = 5e-3, viscosity = 1.; // rotating-disc.toml

    /// Circular Couette flow.
    double exact_torque()
    {
      return 4. * pi * viscosity * a * a * b * b / (b * b - a * a);
    }
    /// Solution of the biharmonic problem in the annulus (Lamb; Happel and Brenner, Low Reynolds number hydrodynamics).
    double exact_drag()
    {
      return 4. * pi * viscosity / (std::log(b / a) - (b * b - a * a) / (b * b + a * a));
    }

    struct Errors
    {
      double       torque, drag_x, drag_y, asymmetry;
      unsigned int n_unknowns;
      double       cell_size; ///< relative: 1 / sqrt(cells)
    };

    Errors errors_on_mesh(const double refinement)
    {
      const Scene coarse =
          shipped_scene("rotating-disc", {"numerics.mesh_size_m=2e-4", "numerics.mesh_size_corner_m=2e-4",
                                          "numerics.mesh_size_far_m=6e-4", "numerics.mesh_growth=0.2"});
      const Scene      scene = shipped_scene("rotating-disc", refined(coarse, refinement));
      const Swimmer<2> disc(scene, MPI_COMM_WORLD);
      const auto       r = compute_resistance(disc, disc.configuration_at_rest(), MPI_COMM_WORLD);
      return {std::abs(r.matrix(2, 2) / exact_torque() - 1.),
              std::abs(r.matrix(0, 0) / exact_drag() - 1.),
              std::abs(r.matrix(1, 1) / exact_drag() - 1.),
              r.asymmetry,
              r.n_unknowns,
              1. / std::sqrt(r.n_cells)};
    }
  } // namespace

  // Reactions converge with the energy: order 4 for quadratic velocities. At least 3 is asked, because the meshes are
  // not nested and the quadratic boundary is off the circle by a term of order 4 with another constant.
  TEST(DiscInCircle, TorqueAndDragConvergeToTheExactOnes)
  {
    std::vector<Errors> errors;
    for (const double refinement : {1., 2., 4.})
    {
      errors.push_back(errors_on_mesh(refinement));
      const auto &e = errors.back();
      std::cout << "disc in circle: " << e.n_unknowns << " unknowns, relative errors: torque " << e.torque << ", drag "
                << e.drag_x << " " << e.drag_y << std::endl;
      EXPECT_LE(e.asymmetry, 1e-10);
    }
    EXPECT_LE(errors[1].n_unknowns, 20000u);
    EXPECT_LE(errors[1].torque, 1e-4);
    EXPECT_LE(errors[1].drag_x, 1e-4);
    EXPECT_LE(errors[1].drag_y, 1e-4);
    const double ratio        = errors[0].cell_size / errors[2].cell_size;
    const double torque_order = observed_order(errors[0].torque, errors[2].torque, ratio),
                 drag_order   = observed_order(errors[0].drag_x, errors[2].drag_x, ratio);
    std::cout << "disc in circle: orders: torque " << torque_order << ", drag " << drag_order << std::endl;
    EXPECT_GE(torque_order, 3.);
    EXPECT_GE(drag_order, 3.);
  }

  // The other way round, through the model that time-steps: the disc is held, the outer circle turns at 1 rad/s.
  TEST(DiscInCircle, TorqueThatHoldsTheDiscInARotatingCircleIsExact)
  {
    const Scene       scene = shipped_scene("rotating-disc");
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    model.advance();
    const auto &balance = model.balance();
    std::cout << "rotating disc: holding torque " << balance.load_that_holds_head.torque[2] << " N, exact "
              << -exact_torque() << ", relative error " << -balance.load_that_holds_head.torque[2] / exact_torque() - 1.
              << ", " << model.n_unknowns() << " unknowns" << std::endl;
    EXPECT_NEAR(balance.load_that_holds_head.torque[2], -exact_torque(), 1e-4 * exact_torque());
    // Nothing pushes it: 1e-4 of the force on a disc that moves as fast as the outer circle.
    EXPECT_NEAR(balance.load_that_holds_head.force[0], 0., 1e-4 * exact_drag() * 5e-3);
    EXPECT_NEAR(balance.load_that_holds_head.force[1], 0., 1e-4 * exact_drag() * 5e-3);
    // All the power of the wall is dissipated; both are sums over the same matrix, so solver tolerance is what is left.
    EXPECT_NEAR(balance.wall, balance.dissipation, 1e-7 * balance.dissipation);
    EXPECT_NEAR(balance.dissipation, exact_torque(), 1e-4 * exact_torque()); // torque times 1 rad/s
  }
} // namespace swimtwin
