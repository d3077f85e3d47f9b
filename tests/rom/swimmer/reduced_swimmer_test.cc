#include <rom/swimmer/reduced_swimmer.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    const SwimmerParameters parameters{1e5, 1.52, 1e5, 3e4};
    const Eigen::Vector2d   field_T(4e-3, -3e-3);

    struct Case
    {
      const char    *name;
      ExampleOptions options;

      friend void PrintTo(const Case &self, std::ostream *stream) { *stream << self.name; }
    };

    class Swimmers : public ::testing::TestWithParam<Case>
    {
    protected:
      SwimmerState draw()
      {
        SwimmerState state(model.n_modes() + 3);
        state << 1e-3 * random(), 1e-3 * random(), 1.5 * random(), random_shape(model, random, 1.4);
        return state;
      }

      VelocityVector rate(const SwimmerState &state, const Eigen::Vector2d &field = field_T,
                          const SwimmerParameters &values = parameters) const
      {
        SwimmerMotion motion = swimmer.make_motion();
        swimmer.set_rate(state, field, values, motion);
        return motion.rate;
      }

      RateDerivatives derivatives(const SwimmerState &state) const
      {
        SwimmerMotion   motion = swimmer.make_motion();
        RateDerivatives result = swimmer.make_derivatives();
        swimmer.differentiate(state, field_T, parameters, motion, result);
        return result;
      }

      /// Of the rate by a number inside the parameters.
      VelocityVector slope(const SwimmerState &state, double SwimmerParameters::*const member) const
      {
        SwimmerParameters after = parameters, before = parameters;
        const double      h = 1e-5 * (parameters.*member);
        after.*member += h;
        before.*member -= h;
        return (rate(state, field_T, after) - rate(state, field_T, before)) / (2. * h);
      }

      const ReducedModel   model   = example_model(GetParam().options);
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      RandomNumbers        random  = RandomNumbers(3);
    };

    void expect_close(const Eigen::VectorXd &value, const Eigen::VectorXd &reference)
    {
      for (Eigen::Index i = 0; i < value.size(); ++i) // components have units of their own
        EXPECT_NEAR(value[i], reference[i], 2e-7 * (std::abs(reference[i]) + 1e-3 * reference.cwiseAbs().maxCoeff()));
    }
  } // namespace

  TEST_P(Swimmers, JacobianIsTheSlopeOfTheRate)
  {
    for (int sample = 0; sample < 10; ++sample)
    {
      const SwimmerState    state    = draw();
      const Eigen::MatrixXd jacobian = derivatives(state).by_state;
      EXPECT_EQ(jacobian.col(0).norm(), 0.);
      EXPECT_EQ(jacobian.col(1).norm() > 0., swimmer.resistance().depends_on_height());
      for (int k = 1; k < swimmer.n_states(); ++k)
      {
        SwimmerState after = state, before = state;
        const double h = k == 2 ? 1e-5 : k == 1 ? 1e-7 : 1e-8;
        after[k] += h;
        before[k] -= h;
        expect_close(jacobian.col(k), (rate(after) - rate(before)) / (2. * h));
      }
    }
  }

  TEST_P(Swimmers, ParameterDerivativesAreSlopes)
  {
    const SwimmerState    state  = draw();
    const RateDerivatives result = derivatives(state);
    expect_close(result.by_young_modulus, slope(state, &SwimmerParameters::young_modulus_Pa));
    expect_close(result.by_viscosity, slope(state, &SwimmerParameters::viscosity_Pa_s));
    expect_close(result.by_magnetization, slope(state, &SwimmerParameters::magnetization_A_m));
    expect_close(result.by_tail_magnetization, slope(state, &SwimmerParameters::tail_magnetization_A_m));
    for (int k = 0; k < 2; ++k)
    {
      const Eigen::Vector2d h = 1e-6 * Eigen::Vector2d::Unit(k);
      expect_close(result.by_field.col(k), (rate(state, field_T + h) - rate(state, field_T - h)) / 2e-6);
    }
  }

  TEST_P(Swimmers, PowersBalance)
  {
    SwimmerMotion motion = swimmer.make_motion();
    for (int sample = 0; sample < 10; ++sample)
    {
      swimmer.move(draw(), field_T, parameters, motion);
      EXPECT_GT(motion.dissipation_W_m, 0.);
      EXPECT_NEAR(motion.magnetic_power_W_m, motion.dissipation_W_m + motion.elastic_power_W_m,
                  1e-12 * (motion.dissipation_W_m + std::abs(motion.elastic_power_W_m)));
    }
  }

  TEST_P(Swimmers, ResistanceBalancesTheForces)
  {
    const SwimmerState state  = draw();
    const ShapeVector  q      = state.tail(model.n_modes());
    SwimmerMotion      motion = swimmer.make_motion();
    swimmer.move(state, field_T, parameters, motion);
    const Eigen::VectorXd load =
        parameters.viscosity_Pa_s * swimmer.resistance().resistance(q, state[2], state[1]) * motion.velocity;
    const Eigen::Vector2d lab_moment = Eigen::Rotation2Dd(state[2]) * swimmer.moment(q, parameters);
    const double          torque     = lab_moment.x() * field_T.y() - lab_moment.y() * field_T.x();
    EXPECT_NEAR(load[2], torque, 1e-12 * std::abs(torque));
    EXPECT_LE(load.head<2>().norm() * swimmer.length_m(), 1e-12 * std::abs(torque));
  }

  TEST_P(Swimmers, AreaIsKeptWhereItMustBeAndOnlyThere)
  {
    const SwimmerState   state     = draw();
    const ShapeVector    gradient  = swimmer.area_gradient(state.tail(model.n_modes()));
    const VelocityVector velocity  = rate(state);
    const double         change    = std::abs(gradient.dot(velocity.tail(model.n_modes())));
    const double         largest   = gradient.norm() * velocity.tail(model.n_modes()).norm();
    const bool           stretches = model.n_modes() > 2; // one of them does
    EXPECT_TRUE(!swimmer.keeps_area() || change <= 1e-13 * largest);
    EXPECT_TRUE(swimmer.keeps_area() || !stretches || change > 1e-6 * largest);
  }

  TEST_P(Swimmers, MirroredSwimmersMoveMirrored)
  {
    Eigen::VectorXd mirror(swimmer.n_states());
    mirror << 1., -1., -1., model.tail.coordinate_parity().cast<double>();
    const SwimmerState   state = draw();
    const VelocityVector there = rate(mirror.cwiseProduct(state), -field_T.cwiseProduct(Eigen::Vector2d(-1., 1.)));
    const double         off   = (there - mirror.cwiseProduct(rate(state))).norm() / there.norm();
    if (GetParam().options.has_mirror)
      EXPECT_LE(off, 1e-13);
    else
      EXPECT_GE(off, 1e-6); // far above round-off
  }

  TEST_P(Swimmers, ScaleWithStiffnessViscosityAndMagnetization)
  {
    const SwimmerState      state = draw();
    const SwimmerParameters scaled{3e5, 3. * 1.52, 3e5, 9e4};
    EXPECT_TRUE(rate(state, field_T, scaled).isApprox(rate(state), 1e-13));
  }

  TEST_P(Swimmers, PrescribedShapeRatesGiveTheSameHeadVelocity)
  {
    const SwimmerState state  = draw();
    const ShapeVector  q      = state.tail(model.n_modes());
    SwimmerMotion      motion = swimmer.make_motion();
    swimmer.move(state, field_T, parameters, motion);
    const Eigen::Vector2d m = swimmer.moment(q, parameters), b = Eigen::Rotation2Dd(-state[2]) * field_T;
    const double          torque = m.x() * b.y() - m.y() * b.x();
    const Eigen::Vector3d head   = swimmer.head_velocity(state, motion.velocity.tail(model.n_modes()), torque,
                                                         parameters.viscosity_Pa_s, motion.resistance);
    EXPECT_LE((head - motion.velocity.head<3>()).norm(), 1e-12 * head.norm());
  }

  TEST_P(Swimmers, TruncatedModelsLackTheLastModes)
  {
    const int            k     = model.n_modes() - 1;
    const ReducedSwimmer fewer = ReducedSwimmer(truncated(model, k));
    SwimmerState         state = draw();
    state.tail<1>().setZero();
    const ShapeVector     q = state.tail(model.n_modes()), q_fewer = q.head(k);
    const Eigen::MatrixXd R = swimmer.resistance().resistance(q, state[2]);
    EXPECT_TRUE(fewer.resistance().resistance(q_fewer, state[2]).isApprox(R.topLeftCorner(k + 3, k + 3), 1e-13));
    EXPECT_TRUE(fewer.energy().gradient(q_fewer).isApprox(swimmer.energy().gradient(q).head(k), 1e-13));
    EXPECT_NEAR(fewer.area_change(q_fewer), swimmer.area_change(q), 1e-13 * q.norm());
    EXPECT_TRUE(fewer.moment(q_fewer, parameters).isApprox(swimmer.moment(q, parameters), 1e-14));
  }

  INSTANTIATE_TEST_SUITE_P(
      Models, Swimmers,
      ::testing::Values(Case{"open", {.depends_on_angle = false}}, Case{"box", {}},
                        Case{"closed", {.keeps_area = true}}, Case{"three_modes", {.n_modes = 3}},
                        Case{"one_mode", {.n_modes = 1, .magnetic_tail = false}}, Case{"followers", {.n_followers = 2}},
                        Case{"closed_with_followers", {.n_followers = 2, .keeps_area = true}},
                        Case{"between_walls", {.depends_on_height = true}}, Case{"off_the_axis", {.has_mirror = false}},
                        Case{"bent", {.n_modes = 2, .is_bent = true}},
                        Case{"bent_between_walls", {.n_modes = 2, .depends_on_height = true, .is_bent = true}}),
      [](const auto &instance) { return instance.param.name; });
} // namespace swimtwin
