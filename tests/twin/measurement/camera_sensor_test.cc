#include <tests/twin/open_swimmer.h>

#include <gtest/gtest.h>

#include <numbers>

namespace swimtwin
{
  namespace
  {
    struct Look
    {
      Eigen::VectorXd residual;
      Eigen::MatrixXd slopes;
    };

    Look look(OpenSwimmer &open, const Sighting &o, const Eigen::VectorXd &state)
    {
      const auto m = open.camera.n_rows(o);
      Look       l{Eigen::VectorXd(m), Eigen::MatrixXd(m, state.size())};
      open.camera.look(o, 0.7, state, l.residual, l.slopes);
      return l;
    }

    TEST(CameraSensor, KnowsHowWhatItSeesDependsOnEverything)
    {
      OpenSwimmer open;
      open.camera.reference_delay_s = 0.02;
      const Eigen::VectorXd state = open.some_state(), change = open.small_change();
      for (const Sighting &o :
           {Sighting{head_position, {1e-3, 2e-3}}, Sighting{head_angle, {0.3, 0.}},
            Sighting{tail_point, {5e-3, 2e-3}, 0., 0.63}, Sighting{tail_point, {5e-3, 2e-3}, 0., 1.}})
      {
        const Look here = look(open, o, state);
        for (Eigen::Index i = 0; i < state.size(); ++i)
        {
          Eigen::VectorXd plus = state, minus = state;
          plus[i] += change[i];
          minus[i] -= change[i];
          const Eigen::VectorXd slope =
              -(look(open, o, plus).residual - look(open, o, minus).residual) / (2. * change[i]);
          EXPECT_LT((here.slopes.col(i) - slope).norm(), 1e-5 * (here.slopes.norm() * 1e-3 + slope.norm()))
              << "kind " << o.kind << ", entry " << i;
        }
      }
    }

    TEST(CameraSensor, SeesAPointOfUnknownPlaceByItsDistanceFromTheAxisAlone)
    {
      OpenSwimmer           open;
      const Eigen::VectorXd state = open.some_state();
      // Where the tail's point at 0.4 is seen, and a point beside it across the axis.
      Sighting at{tail_point, {0., 0.}, 0., 0.4}, before = at, after = at;
      before.place                = 0.39;
      after.place                 = 0.41;
      const Eigen::Vector2d place = -look(open, at, state).residual;
      const Eigen::Vector2d along =
          (look(open, before, state).residual - look(open, after, state).residual).normalized();
      const Eigen::Vector2d across(-along.y(), along.x());
      EXPECT_NEAR(look(open, {tail_distance, place}, state).residual[0], 0., 1e-7);
      EXPECT_NEAR(look(open, {tail_distance, place + 1e-4 * along}, state).residual[0], 0., 1e-6);
      EXPECT_NEAR(look(open, {tail_distance, place + 1e-4 * across}, state).residual[0], 1e-4, 1e-6);
    }

    TEST(CameraSensor, CountsAnglesModuloATurn)
    {
      OpenSwimmer     open;
      Eigen::VectorXd state = open.some_state();
      const double    near  = look(open, {head_angle, {0.3, 0.}}, state).residual[0];
      state[2] += 6. * std::numbers::pi;
      EXPECT_NEAR(look(open, {head_angle, {0.3, 0.}}, state).residual[0], near, 1e-9);
    }

    TEST(CameraSensor, TurnsWhatItSeesBackIntoTheLaboratory)
    {
      OpenSwimmer           open;
      const Eigen::VectorXd state                           = open.some_state();
      Eigen::VectorXd       still                           = state;
      still[open.layout.place(TwinParameter::camera_delay)] = 0.;
      const Eigen::Vector2d seen                            = -look(open, {head_position, {0., 0.}}, still).residual;
      EXPECT_LT((open.camera.in_laboratory(seen, still) - still.head<2>()).norm(), 1e-15);
    }
  } // namespace
} // namespace swimtwin
