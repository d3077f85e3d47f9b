// Motions out of the plane: a rigid magnetic body in fields that turn in space, against its exact equations of motion
// with the resistance of the meshed body, and laws that an elastic swimmer keeps.
#include <fom/resistance/resistance.h>
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>
#include <tests/verification/balance_in_space.h>

#include <Eigen/Dense>
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

    std::vector<std::string> coarse_sphere(std::vector<std::string> more = {})
    {
      more.insert(more.begin(), {"variant=quick", "numerics.mesh_size_m=4e-4", "numerics.mesh_growth=1.0",
                                 "numerics.coupling_tolerance=1e-9", "numerics.linear_tolerance=1e-11"});
      return more;
    }

    /// A rigid body without inertia: R' = omega x R with omega = R Z^-1 R^T (m x B), Z its resistance against turns.
    class ExactTurn
    {
    public:
      explicit ExactTurn(const Scene &scene)
          : scene_(scene), direction_(scene.head.magnetization_direction.data()),
            moment_(scene.head.magnetization_A_m * scene.head.volume(3))
      {
        const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
        const auto resistance = compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD).matrix;
        EXPECT_EQ(resistance.m(), 6u);
        Eigen::Matrix<double, 6, 6> whole;
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j)
            whole(i, j) = resistance(i, j);
        mobility_ = whole.inverse().bottomRightCorner<3, 3>(); // no force acts
      }

      /// Of turns across the moment, in the mean.
      double resistance() const { return 2. / (mobility_.trace() - direction_.dot(mobility_ * direction_)); }
      /// Of turns about the head's x.
      double spin_resistance() const { return 1. / mobility_(0, 0); }
      double moment() const { return moment_; }

      /// The attitude at a time; with a moment of inertia (kg m^2) that of a sphere, which starts from rest.
      Eigen::Quaterniond at(const double time_s, const double inertia = 0.) const
      {
        constexpr int n = 4000;
        const double  h = time_s / n;
        State         y;
        y << 0., 0., 0., 1., 0., 0., 0.;
        for (int i = 0; i < n; ++i)
        {
          const double t  = i * h;
          const State  k1 = rate(y, t, inertia), k2 = rate(y + .5 * h * k1, t + .5 * h, inertia),
                      k3 = rate(y + .5 * h * k2, t + .5 * h, inertia), k4 = rate(y + h * k3, t + h, inertia);
          y += h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
        }
        return Eigen::Quaterniond(Eigen::Vector4d(y.head<4>())).normalized();
      }

    private:
      using State = Eigen::Matrix<double, 7, 1>; ///< quaternion (x, y, z, w), omega

      State rate(const State &y, const double t, const double inertia) const
      {
        const Eigen::Quaterniond q(Eigen::Vector4d(y.head<4>()));
        const Eigen::Matrix3d    R     = q.normalized().toRotationMatrix();
        const auto               field = scene_.field(t);
        const Eigen::Vector3d torque = moment_ * (R * direction_).cross(Eigen::Vector3d(field[0], field[1], field[2]));
        Eigen::Vector3d       omega  = R * mobility_ * R.transpose() * torque;
        State                 rates  = State::Zero();
        if (inertia > 0.)
        {
          omega           = y.tail<3>();
          rates.tail<3>() = (torque - R * mobility_.inverse() * R.transpose() * omega) / inertia;
        }
        rates.head<4>() = .5 * (Eigen::Quaterniond(0., omega[0], omega[1], omega[2]) * q).coeffs();
        return rates;
      }

      const Scene    &scene_;
      Eigen::Vector3d direction_; ///< of the moment, in the head's frame
      double          moment_;
      Eigen::Matrix3d mobility_;
    };

    double angle_between(const Eigen::Quaterniond &a, const Eigen::Quaterniond &b)
    {
      return a.angularDistance(b);
    }

    Eigen::Vector3d field_at(const Scene &scene, const double time_s)
    {
      const auto b = scene.field(time_s);
      return {b[0], b[1], b[2]};
    }

    /// The same scene in another field.
    Scene in_field(Scene scene, const FieldProgram &field, const double periods)
    {
      scene.field         = field;
      scene.time.period_s = field.period_s();
      scene.time.periods  = periods;
      return scene;
    }

    /// Turning in the plane of x and z from x on, as often per second.
    FieldProgram turning_in_xz(const double magnitude_T, const double frequency_Hz)
    {
      constexpr int                      n = 240;
      std::vector<double>                time_s;
      std::vector<std::array<double, 3>> b_T;
      for (int i = 0; i < n; ++i)
      {
        const double phase = 2. * pi * i / n;
        time_s.push_back(i / (n * frequency_Hz));
        b_T.push_back({magnitude_T * std::cos(phase), 0., magnitude_T * std::sin(phase)});
      }
      return FieldProgram::sampled(time_s, b_T, 1. / frequency_Hz);
    }

    Eigen::Quaterniond attitude(const FullOrderModel<3> &model)
    {
      return model.now().configuration.pose.quaternion;
    }
  } // namespace

  TEST(TurningInSpace, IsOfSecondOrderInTimeAgainstTheExactEquation)
  {
    for (const char *direction : {"[1.0, 0.0, 0.0]", "[0.36, -0.48, 0.8]"})
    {
      const auto scene_with = [direction](const int n_steps) {
        return shipped_scene("rotating-sphere-3d",
                             coarse_sphere({"head.magnetization_A_m=5e3", "field.bx_T=4e-3", "field.bz_phase_rad=1.0",
                                            "time.periods=0.25", "time.steps_per_period=" + std::to_string(n_steps),
                                            std::string("head.magnetization_direction=") + direction}));
      };
      const Scene     reference = scene_with(80);
      const ExactTurn exact(reference);
      const auto      error = [&](const int n_steps) {
        const Scene       scene = scene_with(n_steps);
        FullOrderModel<3> model(scene, MPI_COMM_WORLD);
        for (int step = 0; step < scene.time.n_steps(); ++step)
          model.advance();
        const double off = angle_between(attitude(model), exact.at(model.now().time_s));
        std::cout << n_steps << " steps per period: off by " << off << " rad, " << model.n_unknowns() << " unknowns, "
                  << model.coupling().counts().n_iterations << " iterations in " << model.counts().n_steps << " steps"
                  << std::endl;
        EXPECT_NEAR(attitude(model).norm(), 1., 1e-14);
        return off;
      };
      const double coarse = error(80), fine = error(160);
      std::cout << "turning in space, magnetised along " << direction << ": order " << std::log2(coarse / fine)
                << std::endl;
      EXPECT_LT(coarse, 2e-3);
      EXPECT_GE(std::log2(coarse / fine), 1.9);
    }
  }

  // Heavy enough to swing: the moment of inertia over the resistance is a fifth of a second.
  TEST(TurningInSpace, ASphereWithInertiaFollowsItsEquationOfMotion)
  {
    const auto error = [&](const int n_steps) {
      const Scene scene = shipped_scene(
          "rotating-sphere-3d",
          coarse_sphere({"head.magnetization_A_m=5e3", "head.density_kg_m3=2e7", "fluid.inertia=[\"head\"]",
                         "field.bx_T=4e-3", "time.periods=0.5", "time.steps_per_period=" + std::to_string(n_steps)}));
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      for (int step = 0; step < scene.time.n_steps(); ++step)
        model.advance();
      const double    time_s = model.now().time_s, inertia = model.swimmer().head_moment_of_inertia();
      const ExactTurn exact(scene);
      const double    off  = angle_between(attitude(model), exact.at(time_s, inertia)),
                   without = angle_between(attitude(model), exact.at(time_s));
      std::cout << "with inertia, " << n_steps << " steps per period: off by " << off << " rad; without it " << without
                << std::endl;
      EXPECT_LT(off, .05 * without);
      return off;
    };
    const double coarse = error(40), fine = error(80);
    std::cout << "with inertia: order " << std::log2(coarse / fine) << std::endl;
    EXPECT_GE(std::log2(coarse / fine), 1.9);
  }

  // In the plane of y and z: sin(lag) = zeta omega / (m B), whatever the steps, for a steady turn is exact in them.
  TEST(TurningInSpace, ASphereFollowsATurningFieldWithTheExactLag)
  {
    const Scene       scene = shipped_scene("rotating-sphere-3d", coarse_sphere({"time.periods=2.0"}));
    const ExactTurn   exact(scene);
    FullOrderModel<3> model(scene, MPI_COMM_WORLD);
    double            worst_balance = 0.;
    const auto        at_rest       = model.swimmer().surface(model.now().configuration);
    for (int step = 0; step < scene.time.n_steps(); ++step)
    {
      model.advance();
      const auto &balance = model.balance();
      worst_balance       = std::max(worst_balance, std::abs(balance.magnetic / balance.dissipation - 1.));
    }
    const Eigen::Vector3d m = attitude(model).toRotationMatrix().col(0), B = field_at(scene, model.now().time_s);
    const double          lag       = std::atan2(m.cross(B).norm(), m.dot(B));
    const double          expected  = std::asin(exact.resistance() * pi / (exact.moment() * B.norm()));
    const double          unbounded = std::asin(8. * pi * 1.52 * std::pow(.5e-3, 3) * pi / (exact.moment() * B.norm()));
    std::cout << "a sphere lags " << lag << " rad, exactly " << expected << " (in an unbounded fluid " << unbounded
              << "); out of the plane by " << m[0] << "; balance open by " << worst_balance << std::endl;
    EXPECT_NEAR(lag, expected, 1e-3 * expected);
    EXPECT_NEAR(expected, unbounded, .1 * unbounded); // a coarse sphere
    EXPECT_LE(std::abs(m[0]), 2e-3);                  // the mesh is no sphere
    EXPECT_LT(m.cross(B)[0], 0.);                     // it is behind: the field turns from z to y
    EXPECT_LE(worst_balance, 1e-6);

    // Rigid: no distance on it has changed.
    const auto now    = model.swimmer().surface(model.now().configuration);
    double     change = 0.;
    for (unsigned int k = 1; k < now.size(); ++k)
      change = std::max(change, std::abs(now[k].distance(now[0]) - at_rest[k].distance(at_rest[0])));
    EXPECT_LE(change, 1e-14 * scene.body_length_m());
  }

  // A magnet across the axis of a body that the field makes spin about it.
  TEST(TurningInSpace, AMagnetAcrossTheAxisSpinsTheBodyAboutIt)
  {
    const Scene scene = shipped_scene(
        "rotating-sphere-3d", coarse_sphere({"head.magnetization_direction=[0.0, 2.0, 0.0]", "time.periods=2.0"}));
    const ExactTurn   exact(scene);
    FullOrderModel<3> model(scene, MPI_COMM_WORLD);
    for (int step = 0; step < scene.time.n_steps(); ++step)
      model.advance();
    const Eigen::Matrix3d R = attitude(model).toRotationMatrix();
    const Eigen::Vector3d m = R.col(1), B = field_at(scene, model.now().time_s);
    const double          lag = std::atan2(m.cross(B).norm(), m.dot(B)),
                 expected     = std::asin(exact.spin_resistance() * pi / (exact.moment() * B.norm()));
    const double off          = angle_between(attitude(model), exact.at(model.now().time_s));
    std::cout << "a sphere with a magnet across lags " << lag << " rad, exactly " << expected
              << "; its attitude is off by " << off << std::endl;
    EXPECT_NEAR(lag, expected, 1e-3 * expected);
    EXPECT_LE(off, 5e-4);
  }

  // In the plane of x and z, at 0.9 and 1.1 times the frequency m B / (2 pi zeta) at which it steps out.
  TEST(TurningInSpace, ASphereStepsOutWhereItsLagWouldBeMoreThanAQuarterTurn)
  {
    const Scene     still = shipped_scene("rotating-sphere-3d", coarse_sphere({"time.steps_per_period=40"}));
    const ExactTurn body(still);
    const double    step_out_Hz = body.moment() * 5e-3 / (2. * pi * body.resistance());
    for (const double share : {.9, 1.1})
    {
      const Scene       scene = in_field(still, turning_in_xz(5e-3, share * step_out_Hz), 3.);
      const ExactTurn   exact(scene);
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      double            turn = 0.; // about -y, from x to z
      for (int step = 0; step < scene.time.n_steps(); ++step)
      {
        const Attitude<3> before = model.now().configuration.pose;
        model.advance();
        turn -= model.now().configuration.pose.turn_from(before)[1];
      }
      // theta' = w_c sin(w t - theta), by small steps of x = w t - theta.
      double        x = 0.;
      constexpr int n = 40000;
      for (int i = 0; i < n; ++i)
      {
        const double h = 2. * pi * step_out_Hz * model.now().time_s / n, k = share - std::sin(x);
        x += h * (share - std::sin(x + .5 * h * k));
      }
      const double expected = 2. * pi * 3. - x;
      std::cout << "at " << share << " of the frequency of stepping out: turned by " << turn
                << " rad in three periods, "
                << "by theory " << expected << "; attitude off by "
                << angle_between(attitude(model), exact.at(model.now().time_s)) << " rad" << std::endl;
      EXPECT_NEAR(turn, expected, 1e-2 * expected);
      if (share < 1.)
        EXPECT_LT(x, pi / 2.);
      else
        EXPECT_GT(2. * pi * 3. - turn, pi / 2.);
    }
  }

  // The field of `open-3d` along z in the place of y: everything is turned about x, and the mesh is not.
  TEST(TurningInSpace, ASwimmerInATurnedFieldMovesAsThePlanarOneTurned)
  {
    const std::vector<std::string> in_plane{"variant=quick", "time.steps_per_period=20", "time.periods=0.15"};
    auto                           turned_settings = in_plane;
    turned_settings.insert(turned_settings.end(), {"field.by_T=0.0", "field.bz_T=5e-3"});
    const Scene       planar = shipped_scene("open-3d", in_plane), turned = shipped_scene("open-3d", turned_settings);
    FullOrderModel<3> a(planar, MPI_COMM_WORLD), b(turned, MPI_COMM_WORLD);
    for (int step = 0; step < planar.time.n_steps(); ++step)
    {
      a.advance();
      b.advance();
    }
    const auto tip = [](const FullOrderModel<3> &model) {
      return model.swimmer().tail_positions(model.now().configuration)[model.swimmer().tail().axis_at_tip[2]];
    };
    const Point<3>     planar_tip = tip(a), turned_tip = tip(b);
    const Point<3>     expected(planar_tip[0], -planar_tip[2], planar_tip[1]);
    const double       moved = std::abs(planar_tip[1]);
    const Tensor<1, 3> omega = a.now().rates.omega, turned_omega = b.now().rates.omega;
    std::cout << "turned field: tip at " << turned_tip << ", expected " << expected << "; omega " << turned_omega
              << ", expected " << 0. << ' ' << -omega[2] << ' ' << omega[1] << "; unknowns " << a.n_unknowns()
              << " and " << b.n_unknowns() << std::endl;
    EXPECT_GT(moved, .01 * planar.body_length_m());
    EXPECT_LE(turned_tip.distance(expected), 2e-2 * moved);
    EXPECT_NEAR(turned_omega[1], -omega[2], 2e-2 * std::abs(omega[2]));
    EXPECT_NEAR(b.balance().magnetic, a.balance().magnetic, 2e-2 * a.balance().magnetic);
  }

  // Over the sixth step of forty in a field that swings across the plane, as in it (swimmer_in_space_test.cc): powers
  // grow as the square of time there, and the trapezoidal rule on them is off by half a per cent itself, before.
  TEST(TurningInSpace, PowerBalancesOutOfThePlane)
  {
    for (const char *inertia : {"none", "full"})
    {
      const Scene scene = shipped_scene("open-3d", {"variant=quick", "numerics.mesh_size_m=8e-4", "field.by_T=4e-3",
                                                    "field.bz_T=3e-3", std::string("fluid.inertia=") + inertia});
      FullOrderModel<3> model(scene, MPI_COMM_WORLD);
      for (int step = 0; step < 5; ++step)
        model.advance();
      const auto [work, missing] = advance_and_balance(model, scene.time.time_step_s());
      std::cout << "field across the plane, inertia " << inertia << ": balance open by " << missing / work << ", "
                << model.coupling().counts().n_iterations << " iterations in " << model.counts().n_steps << " steps"
                << std::endl;
      EXPECT_LE(std::abs(missing), 5e-3 * std::abs(work));
    }
  }
} // namespace swimtwin
