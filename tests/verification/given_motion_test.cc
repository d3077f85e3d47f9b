// Bodies that move as a scene prescribes: the force of the flow against an exact solution and a published one, and
// reciprocal and other strokes of a swimmer.
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>
#include <tests/observed_order.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <iostream>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;
    using Complex = std::complex<double>;

    /// Modified Bessel functions I0, I1, K0, K1 of an argument with a positive real part, by the trapezoidal rule on
    /// their integral representations (DLMF 10.32.3 and 10.32.9), which converges faster than any power of the step.
    struct ModifiedBessel
    {
      Complex i0 = 0., i1 = 0., k0 = 0., k1 = 0.;

      explicit ModifiedBessel(const Complex z)
      {
        constexpr int n = 400;
        for (int j = 0; j <= n; ++j)
        {
          const double  end   = j == 0 || j == n ? .5 : 1.;
          const double  theta = pi * j / n, t = 8. * j / n;
          const Complex growth = end / n * std::exp(z * std::cos(theta)),
                        decay  = end * 8. / n * std::exp(-z * std::cosh(t));
          i0 += growth;
          i1 += growth * std::cos(theta);
          k0 += decay;
          k1 += decay * std::cosh(t);
        }
      }
    };

    /// Force (N/m) of the fluid on a disc of radius a per velocity e^{iwt} along x, in the middle of a circle of radius
    /// b at rest: psi = (A r + B / r + C I1(k r) + D K1(k r)) sin(theta) with k^2 = i w rho / mu, both velocities given
    /// on both circles. Pressure and the vorticity's traction add up to i w rho pi (a^2 U - 2 B).
    Complex force_by_velocity(const double a, const double b, const double density, const double viscosity,
                              const double angular_frequency)
    {
      const Complex          iw_rho(0., angular_frequency * density), k = std::sqrt(iw_rho / viscosity);
      const ModifiedBessel   at_a(k * a), at_b(k * b);
      Eigen::Matrix4cd       matrix;
      const Eigen::Vector4cd velocity(1., 1., 0., 0.);
      for (const auto &[row, r, f] : {std::tuple{0, a, at_a}, std::tuple{2, b, at_b}})
      {
        matrix.row(row) << 1., 1. / (r * r), f.i1 / r, f.k1 / r;                                             // f / r
        matrix.row(row + 1) << 1., -1. / (r * r), k * (f.i0 - f.i1 / (k * r)), -k * (f.k0 + f.k1 / (k * r)); // f'
      }
      // Columns of like size.
      const Eigen::Vector4cd size(1., a * a, a / at_b.i1, a / at_a.k1);
      const Eigen::Vector4cd x = size.asDiagonal() * (matrix * size.asDiagonal()).fullPivLu().solve(velocity).eval();
      return iw_rho * pi * (a * a - 2. * x[1]);
    }

    /// Of the fluid on the body, along x, at every step of the last period.
    struct LastPeriod
    {
      std::vector<double> velocity_m_s, force_N_m;
      double              imbalance = 0.;
    };

    LastPeriod last_period(const Scene &scene)
    {
      FullOrderModel<2> model(scene, MPI_COMM_WORLD);
      LastPeriod        period;
      for (int step = 1; step <= scene.time.n_steps(); ++step)
      {
        model.advance();
        if (step > scene.time.n_steps() - scene.time.steps_per_period)
        {
          period.velocity_m_s.push_back(model.now().rates.velocity[0]);
          period.force_N_m.push_back(model.balance().load_of_fluid.force[0]);
        }
      }
      return period;
    }

    /// First harmonic of a period's values against e^{iwt}, t = 0 at the period's beginning.
    Complex harmonic(const std::vector<double> &values)
    {
      Complex   sum = 0.;
      const int n   = values.size();
      for (int i = 0; i < n; ++i)
        sum += 2. / n * values[i] * std::polar(1., -2. * pi * (i + 1) / n);
      return sum;
    }

    Complex ratio_to_exact(const int steps_per_period)
    {
      const Scene scene =
          shipped_scene("oscillating-disc", {"time.steps_per_period=" + std::to_string(steps_per_period)});
      const LastPeriod period = last_period(scene);
      const Complex    exact =
          force_by_velocity(scene.head.size_m[0] / 2., scene.domain->radius_m, scene.fluid->density_kg_m3,
                            scene.fluid->viscosity_Pa_s, 2. * pi * scene.head.oscillation.frequency_Hz);
      const Complex ratio = harmonic(period.force_N_m) / harmonic(period.velocity_m_s) / exact;
      std::cout << "disc swinging in a circle, " << steps_per_period << " steps: exact phase of the force "
                << std::arg(exact) << ", off by " << std::abs(ratio) - 1. << " of the amplitude, " << std::arg(ratio)
                << " rad" << std::endl;
      return ratio;
    }

    /// Angular velocity (rad/s) at every step of a free body between walls that move against each other.
    std::vector<double> angles_in_shear(const Scene &scene)
    {
      FullOrderModel<2>   model(scene, MPI_COMM_WORLD);
      std::vector<double> angles{model.now().configuration.pose.angle};
      for (int step = 1; step <= scene.time.n_steps(); ++step)
      {
        model.advance();
        angles.push_back(model.now().configuration.pose.angle);
      }
      return angles;
    }

    /// Displacement (m) along x in the last period.
    double last_displacement(const Scene &scene)
    {
      FullOrderModel<2> model(scene, MPI_COMM_WORLD);
      double            start = 0.;
      for (int step = 1; step <= scene.time.n_steps(); ++step)
      {
        model.advance();
        if (step == scene.time.n_steps() - scene.time.steps_per_period)
          start = model.now().configuration.pose.center[0];
      }
      return model.now().configuration.pose.center[0] - start;
    }

    const std::vector<std::string> coarse{"variant=tutorial", "time.steps_per_period=40"};

    std::vector<std::string> and_more(std::vector<std::string> overrides, const std::vector<std::string> &more)
    {
      overrides.insert(overrides.end(), more.begin(), more.end());
      return overrides;
    }
  } // namespace

  // What the exact solution says where it is known otherwise: slowly, the drag of Stokes' flow (reference: sphere and
  // disc in a concentric circle); fast, the added mass pi rho a^2 (b^2 + a^2) / (b^2 - a^2) of a flow without
  // viscosity.
  TEST(DiscSwingingInCircle, ExactForceHasBothLimits)
  {
    const double a = 1e-3, b = 2.5e-3, a_sq = a * a, b_sq = b * b;
    const double drag = 4. * pi * 1e-3 / (std::log(b / a) - (b_sq - a_sq) / (b_sq + a_sq));
    EXPECT_NEAR(std::abs(force_by_velocity(a, b, 1000., 1e-3, 1e-3) / -drag - 1.), 0., 1e-3);
    const double  added_mass = 1000. * pi * a_sq * (b_sq + a_sq) / (b_sq - a_sq), fast = 2. * pi * 1e3;
    const Complex force = force_by_velocity(a, b, 1000., 1e-3, fast);
    const double  layer = std::sqrt(1e-6 / fast) / a; // of the boundary layer, relative to the disc
    EXPECT_NEAR(-force.imag() / (fast * added_mass), 1., 10. * layer);
  }

  TEST(DiscSwingingInCircle, ForceHasTheExactAmplitudeAndPhase)
  {
    const Complex ratio = ratio_to_exact(100);
    EXPECT_NEAR(std::abs(ratio), 1., 5e-3);
    EXPECT_NEAR(std::arg(ratio), 0., 5e-3);
  }

  // The coefficients of Morison's formula by Fourier averages over the last period, as G. H. Keulegan and L. H.
  // Carpenter have them (J. Res. Natl. Bur. Stand. 60, 1958); the mean of |cos| cos^2 is 4 / (3 pi). Least squares
  // weigh otherwise, and give a drag coefficient that is 3 % lower.
  TEST(OscillatingCylinder, DragAndAddedMassAreThePublishedOnes)
  {
    const Scene      scene  = shipped_scene("oscillating-cylinder", {"variant=tutorial"});
    const LastPeriod period = last_period(scene);
    const double     D = scene.head.size_m[0], rho = scene.fluid->density_kg_m3,
                 rate = 2. * pi * scene.head.oscillation.frequency_Hz, U = rate * scene.head.oscillation.amplitude_m[0];
    const Complex force = harmonic(period.force_N_m) * std::polar(1., -scene.head.oscillation.phase_rad); // u = U cos
    const double  drag  = -force.real() / (.5 * rho * D * U * U * 8. / (3. * pi));
    const double  mass  = -force.imag() / (.25 * pi * rho * D * D * U * rate);
    std::cout << "oscillating cylinder: drag coefficient " << drag << ", added mass " << mass << std::endl;
    EXPECT_NEAR(drag, 2.09, .02 * 2.09);
    EXPECT_NEAR(mass, 1.45, .02 * 1.45);
  }

  TEST(BodyInShear, DiscTurnsWithHalfOfTheShearRate)
  {
    const auto angles = angles_in_shear(shipped_scene("disc-in-shear", {"time.duration_s=1.0", "time.steps=10"}));
    std::cout << "disc in shear: angular velocity " << angles.back() << " rad/s" << std::endl;
    EXPECT_NEAR(angles.back(), -.5, .5 * 5e-3);
  }

  // tan(phi) = tan(r t / (r^2 + 1)) / r for a body that stands along the stream at first (r: ratio of its axes).
  TEST(BodyInShear, EllipseTurnsAsJefferySays)
  {
    const Scene  scene  = shipped_scene("ellipse-in-shear", {"time.steps=100"});
    const auto   angles = angles_in_shear(scene);
    double       worst  = 0.;
    const double dt = scene.time.time_step_s(), r = scene.head.size_m[0] / scene.head.size_m[1];
    for (std::size_t i = 0; i < angles.size(); ++i)
    {
      const double turned = r / (r * r + 1.) * i * dt;
      const double exact  = std::atan2(std::sin(turned), r * std::cos(turned));
      worst               = std::max(worst, std::abs(std::remainder(-angles[i] - exact, 2. * pi)));
    }
    std::cout << "ellipse in shear: angle off by " << worst << " rad at most, after a turn by "
              << -angles.back() - 2. * pi << std::endl;
    EXPECT_LE(std::abs(-angles.back() / (2. * pi) - 1.), 5e-3);
    EXPECT_LE(worst, .03); // half a per cent of a turn, where it turns fastest
  }

  // Purcell's theorem, up to an error of the steps that falls faster than their square, and that it ends with inertia.
  TEST(FlappingSwimmer, GetsSomewhereWithInertiaOnly)
  {
    const auto without_inertia = [](const std::string &steps) {
      return std::abs(
          last_displacement(shipped_scene("flapping-swimmer", and_more(coarse, {"fluid.inertia=\"none\"", steps}))));
    };
    const double with        = std::abs(last_displacement(shipped_scene("flapping-swimmer", coarse)));
    const double long_steps  = without_inertia("time.steps_per_period=40"),
                 short_steps = without_inertia("time.steps_per_period=80");
    std::cout << "flapping swimmer: displacement in a period " << long_steps << " and " << short_steps
              << " m without inertia, " << with << " with" << std::endl;
    EXPECT_LE(short_steps, 1e-3 * with);
    EXPECT_LE(short_steps, long_steps / 4.);
  }

  TEST(WavingSwimmer, SwimsHeadFirstAndAlikeInOppositeWaves)
  {
    const Scene  scene = shipped_scene("waving-swimmer", coarse);
    const double ahead = last_displacement(scene), L = scene.body_length_m();
    const double back = last_displacement(shipped_scene("waving-swimmer", and_more(coarse, {"tail.wave.waves=-1.0"})));
    std::cout << "waving swimmer: " << ahead / L << " body lengths in a period, the other way round " << back / L
              << std::endl;
    EXPECT_LE(ahead, -.01 * L);
    EXPECT_GE(back, .01 * L);
  }
} // namespace swimtwin
