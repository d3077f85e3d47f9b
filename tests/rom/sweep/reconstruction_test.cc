#include <rom/integration/swimmer_integrator.h>
#include <rom/sweep/reconstruction.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <numbers>

namespace swimtwin
{
  namespace
  {
    class Tails : public ::testing::Test
    {
    protected:
      SwimmerState draw()
      {
        SwimmerState state(model.n_modes() + 3);
        state << 1e-3 * random(), 1e-3 * random(), 0.7, random_shape(model, random, 1.);
        return state;
      }

      const ReducedModel model  = example_model();
      RandomNumbers      random = RandomNumbers(9);
    };
  } // namespace

  TEST_F(Tails, LieWhereHeadAndShapePutThem)
  {
    SwimmerState state = SwimmerState::Zero(model.n_modes() + 3);
    state.head<3>() << 1e-3, 2e-3, std::numbers::pi / 2.;
    const Eigen::MatrixXd there = tail_positions(model.tail, state);
    for (int i = 0; i < there.rows(); ++i)
    {
      EXPECT_NEAR(there(i, 0), 1e-3 - model.tail.nodes_m(i, 1), 1e-17);
      EXPECT_NEAR(there(i, 1), 2e-3 + model.tail.nodes_m(i, 0), 1e-17);
    }
  }

  TEST_F(Tails, TipIsANodeOfTheTail)
  {
    const SwimmerState    state = draw();
    const TailTip         tip(model.tail);
    const Eigen::Vector2d place = state.head<2>() + Eigen::Rotation2Dd(state[2]) * tip.position_m(state.tail(4));
    EXPECT_LE((place - tail_positions(model.tail, state).row(model.tail.tip_node).transpose()).norm(), 1e-17);
  }

  TEST_F(Tails, AngleOfTheTipIsThatOfTheMaterialAxis)
  {
    const TailTip tip(model.tail);
    EXPECT_EQ(tip.angle_rad(Eigen::VectorXd::Zero(4)), 0.);
    ShapeVector q           = Eigen::VectorXd::Zero(4);
    q[0]                    = 1e-4; // the first mode bends by c s^2, s from 0 to 1 over 7.5 mm
    const double deflection = tip.position_m(q).y();
    EXPECT_NEAR(tip.angle_rad(q), std::atan(2. * deflection / 7.5e-3), 1e-12);
  }

  // The plane of motion of a tail in space is the planar tail: the same nodes and modes, and others beside them.
  TEST_F(Tails, InSpaceMoveInThePlaneAsTheirSectionDoes)
  {
    const Eigen::Index n             = model.tail.nodes_m.rows();
    ReducedTail        tail          = model.tail;
    tail.nodes_m                     = Eigen::MatrixXd::Zero(n + 1, 3);
    tail.nodes_m.topLeftCorner(n, 2) = model.tail.nodes_m;
    tail.nodes_m(n, 2)               = 1e-4;
    tail.modes                       = Eigen::MatrixXd::Zero(3 * (n + 1), model.tail.modes.cols());
    for (Eigen::Index a = 0; a < n; ++a)
      tail.modes.middleRows(3 * a, 2) = model.tail.modes.middleRows(2 * a, 2);
    tail.modes.bottomRows(1).setConstant(.5); // along z
    tail.cells                  = Eigen::MatrixXi::Constant(model.tail.cells.rows(), 10, static_cast<int>(n));
    tail.cells.leftCols(3)      = model.tail.cells.leftCols(3);
    tail.cells.middleCols(4, 3) = model.tail.cells.rightCols(3);

    const SwimmerState    state = draw();
    const Eigen::MatrixXd x = tail_positions(tail, state), in_plane = tail_positions(model.tail, state);
    EXPECT_LE((x.topLeftCorner(n, 2) - in_plane).cwiseAbs().maxCoeff(), 1e-18);
    EXPECT_EQ(x.col(2).head(n).norm(), 0.);
    EXPECT_NEAR(x(n, 2), 1e-4 + .5 * state.tail(4).sum(), 1e-15);
    EXPECT_EQ(TailTip(tail).position_m(state.tail(4)), TailTip(model.tail).position_m(state.tail(4)));
    EXPECT_EQ(TailTip(tail).angle_rad(state.tail(4)), TailTip(model.tail).angle_rad(state.tail(4)));
  }

  TEST_F(Tails, SnapshotsHoldTheRun)
  {
    RunRequest request         = example_request(model);
    request.samples_per_period = 10;
    request.n_periods          = 1;
    const ReducedSwimmer swimmer(model);
    const SwimmerRun     run = SwimmerIntegrator(swimmer, {}).run(request);
    const SnapshotSet    set = reconstruct(model.tail, request.drive, run.snapshots);
    ASSERT_EQ(set.time_s.size(), 11u);
    EXPECT_NEAR(set.time_s[4], 0.5, 1e-12);
    EXPECT_EQ(set.clamped_nodes.size(), 5); // those on the head
    EXPECT_EQ(set.pose(10, 2), run.trajectory.back().head_angle_rad);
    EXPECT_NEAR(set.field_T(10, 0), 5e-3, 1e-18);
    const Eigen::VectorXd last = set.tail_displacement_m.row(10);
    EXPECT_TRUE(last.isApprox(model.tail.modes * run.at_period_end.back().tail(4), 1e-6));
    // Velocity is the displacement's rate: central difference over two samples.
    const Eigen::VectorXd rate = (set.tail_displacement_m.row(6) - set.tail_displacement_m.row(4)) / 0.25;
    EXPECT_LE((rate - set.tail_velocity_m_s.row(5).transpose()).norm(), 0.2 * rate.norm());
  }

  // Followers are amplitudes that the state does not have: shapes come from its coordinates.
  TEST(TailsWithFollowers, SnapshotsHoldTheRun)
  {
    const ReducedModel model   = example_model({.n_followers = 2});
    RunRequest         request = example_request(model);
    request.samples_per_period = 10;
    request.n_periods          = 1;
    const ReducedSwimmer swimmer(model);
    const SwimmerRun     run = SwimmerIntegrator(swimmer, {}).run(request);
    const SnapshotSet    set = reconstruct(model.tail, request.drive, run.snapshots);
    ASSERT_EQ(run.snapshots.size(), 11u);
    for (int i = 0; i < 11; ++i)
    {
      const SwimmerState   &state = run.snapshots[i].state;
      const Eigen::VectorXd shape = tail_displacement(model.tail, state.tail(model.n_modes()));
      EXPECT_EQ(set.tail_displacement_m.row(i).transpose(), shape);
      const Eigen::MatrixXd    there = tail_positions(model.tail, state);
      const Eigen::Rotation2Dd R(state[2]);
      for (int a = 0; a < there.rows(); ++a)
        EXPECT_LE((there.row(a).transpose() - state.head<2>() -
                   R * Eigen::Vector2d(model.tail.nodes_m.row(a).transpose() + shape.segment<2>(2 * a)))
                      .norm(),
                  1e-15);
    }
  }

  TEST_F(Tails, VelocityIsTheRateOfTheDisplacement)
  {
    const ReducedTail     tail = example_model({.n_followers = 2}).tail;
    const ShapeVector     q = draw().tail(4), rate = 30. * draw().tail(4);
    const double          h = 1e-6;
    const Eigen::VectorXd difference =
        (tail_displacement(tail, q + h * rate) - tail_displacement(tail, q - h * rate)) / (2. * h);
    const Eigen::VectorXd velocity = tail_velocity(tail, q, rate);
    EXPECT_LE((velocity - difference).norm(), 1e-8 * velocity.norm());
  }

  TEST_F(Tails, MassIsTheTailsArea)
  {
    const SnapshotSet  set = reconstruct(model.tail, example_request(model).drive, {});
    const Eigen::Index n   = model.tail.nodes_m.size();
    Eigen::VectorXd    x   = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; i += 2)
      x[i] = 1.;
    EXPECT_NEAR(x.dot(set.tail_mass_m2 * x), 7.5e-3 * 0.6e-3, 1e-15);
    EXPECT_LE((set.tail_mass_m2 - Eigen::SparseMatrix<double>(set.tail_mass_m2.transpose())).norm(), 1e-20);
  }
} // namespace swimtwin
