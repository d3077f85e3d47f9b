#include <fom/step/full_order_model.h>

#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// The reference swimmer on a mesh as coarse as it gets, solved to the last digits.
    std::vector<std::string> coarse_and_tight(std::vector<std::string> more = {})
    {
      std::vector<std::string> overrides = {"numerics.mesh_size_m=6e-4",         "numerics.mesh_size_corner_m=2e-4",
                                            "numerics.mesh_size_far_m=4e-3",     "numerics.mesh_growth=0.5",
                                            "numerics.coupling_tolerance=1e-11", "numerics.linear_tolerance=1e-13",
                                            "time.steps_per_period=20",          "fluid.inertia=none"};
      overrides.insert(overrides.end(), more.begin(), more.end());
      return overrides;
    }

    /// Rate of the elastic energy: internal forces times rates, both in the head's frame.
    double elastic_power(const FullOrderModel<2> &model)
    {
      const auto               &elasticity = model.swimmer().elasticity();
      const auto               &now        = model.now();
      ElasticTail<2>::CellForce force;
      double                    power = 0.;
      for (unsigned int c = 0; c < elasticity.mesh().n_cells(); ++c)
      {
        elasticity.cell_force(c, now.configuration.shape, force);
        for (unsigned int i = 0; i < force.size(); ++i)
          power += force[i] * now.rates.shape_rate[elasticity.mesh().cells[c][i / 2]][i % 2];
      }
      return power;
    }

    double distance(const Configuration<2> &a, const Configuration<2> &b)
    {
      double largest = std::max(a.pose.center.distance(b.pose.center), std::abs(a.pose.angle - b.pose.angle) * 8e-3);
      for (unsigned int i = 0; i < a.shape.size(); ++i)
        largest = std::max(largest, (a.shape[i] - b.shape[i]).norm());
      return largest;
    }
  } // namespace

  // One weak form tested with its own solution. The tail is stiff: an iterate that is off by the coupling's tolerance
  // of 1e-11 lengths is off by up to 1e-11 L / h ~ 1e-9 in strain, against strains of 1e-2: 1e-6 covers it.
  TEST(FullOrderModel, PowersOfAConvergedStepBalance)
  {
    const Scene       scene = shipped_scene("reference-2d-casefile", coarse_and_tight());
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    for (int step = 0; step < 3; ++step)
    {
      model.advance();
      const auto &b = model.balance();
      EXPECT_GT(b.dissipation, 0.);
      EXPECT_NEAR(b.magnetic, b.dissipation + elastic_power(model), 1e-6 * b.dissipation);
      EXPECT_EQ(b.wall, 0.);
      EXPECT_EQ(b.gravity, 0.);
      EXPECT_EQ(b.load_that_holds_head.torque[2], 0.); // free
    }
    EXPECT_EQ(model.counts().n_step_halvings, 0);
  }

  TEST(FullOrderModel, FixedHeadStandsStillAndItsHolderBearsTheTorque)
  {
    const Scene       scene = shipped_scene("reference-2d-casefile", coarse_and_tight({"head.motion=fixed"}));
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    const auto        rest = model.now().configuration;
    for (int step = 0; step < 2; ++step)
      model.advance();
    EXPECT_EQ(distance(model.now().configuration, rest), 0.);
    const double torque = model.swimmer().torque_on_head({0.}, model.now().time_s).torque[0];
    EXPECT_NEAR(model.balance().load_that_holds_head.torque[2], -torque, 1e-12 * std::abs(torque));
    EXPECT_NEAR(model.balance().magnetic, 0., 1e-20);
  }

  TEST(FullOrderModel, WithoutAFieldNothingMoves)
  {
    const Scene scene = shipped_scene("reference-2d-casefile", coarse_and_tight({"field.bx_T=0.0", "field.by_T=0.0"}));
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    const auto        rest = model.now().configuration;
    model.advance();
    EXPECT_EQ(distance(model.now().configuration, rest), 0.);
  }

  // Without inertia only ratios count. Powers of two scale every number of the system alike, but for the solver's
  // preconditioned norms: the tolerances of the iterations are what is left, 1e-11 and 1e-13 per step.
  TEST(FullOrderModel, ScalingViscosityStiffnessAndMagnetizationTogetherChangesNothing)
  {
    const Scene once  = shipped_scene("reference-2d-casefile", coarse_and_tight()),
                twice = shipped_scene("reference-2d-casefile",
                                      coarse_and_tight({"fluid.viscosity_Pa_s=3.04", "tail.young_modulus_Pa=16e4",
                                                        "head.magnetization_A_m=4e5"}));
    FullOrderModel<2> a(once, MPI_COMM_WORLD), b(twice, MPI_COMM_WORLD);
    for (int step = 0; step < 4; ++step)
    {
      a.advance();
      b.advance();
    }
    EXPECT_GT(std::abs(a.now().configuration.pose.angle), 0.1); // it does move
    EXPECT_LE(distance(a.now().configuration, b.now().configuration), 1e-8 * once.body_length_m());
    EXPECT_NEAR(b.balance().dissipation, 2. * a.balance().dissipation, 1e-7 * b.balance().dissipation);
  }

  TEST(FullOrderModel, StopsOnTheTimeGrid)
  {
    const Scene       scene = shipped_scene("rotating-disc", {"time.steps=3"});
    FullOrderModel<2> model(scene, MPI_COMM_WORLD);
    for (int step = 1; step <= 3; ++step)
    {
      model.advance();
      EXPECT_DOUBLE_EQ(model.now().time_s, step / 3.);
    }
  }
} // namespace swimtwin
