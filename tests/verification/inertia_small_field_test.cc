// In a weak field across a bias the swimmer with inertia is a linear system, which one complex solve at the field's
// frequency knows as well as all the time steps.
#include <fom/body/mesh_around.h>
#include <fom/coupling/coupled_system.h>
#include <fom/step/full_order_model.h>
#include <tests/fom/shipped_scene.h>

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace swimtwin
{
  namespace
  {
    using Complex       = std::complex<double>;
    using ComplexMatrix = Eigen::SparseMatrix<Complex>;

    /// Amplitudes of what moves: angular velocity (rad/s), head's and tail tip's velocity (m/s) across, the tip's seen
    /// from the head without its turn.
    struct Amplitudes
    {
      Complex omega, head, tip;
    };

    double largest_deviation(const Amplitudes &a, const Amplitudes &b)
    {
      return std::max({std::abs(a.omega / b.omega - 1.), std::abs(a.head / b.head - 1.), std::abs(a.tip / b.tip - 1.)});
    }

    /// The coupled system at rest. What is assembled for a step of slope weight c is D + c K + M / c, of drag,
    /// stiffness and inertia; a motion whose rates are s times itself obeys it with c = 1/s, for a complex s, too.
    class LinearSwimmer
    {
    public:
      explicit LinearSwimmer(const Scene &scene) : swimmer_(scene, MPI_COMM_WORLD) {}

      Amplitudes respond(const Complex growth)
      {
        // Three real slope weights give D, K and M, or what is wanted of them at once.
        const double                unit = 1. / std::abs(growth);
        const std::array<double, 3> slope_weights{.4 * unit, unit, 2.5 * unit};
        Eigen::Matrix3cd            conditions;
        for (int k = 0; k < 3; ++k)
          conditions.col(k) << 1., slope_weights[k] / unit, unit / slope_weights[k];
        const Eigen::Vector3cd weights =
            conditions.partialPivLu().solve(Eigen::Vector3cd(1., 1. / (growth * unit), growth * unit));
        ComplexMatrix matrix(system_.n_unknowns(), system_.n_unknowns());
        for (int k = 0; k < 3; ++k)
          matrix += weights[k] * assemble(slope_weights[k]);
        return solve(matrix);
      }

    private:
      ComplexMatrix assemble(const double slope_weight)
      {
        fluid_.begin_step(Bdf2(slope_weight, 0.));
        Rates<2> at_rest;
        at_rest.shape_rate.resize(rest_.shape.size());
        const BodyVelocities<2> known{{}, {}, {}, NodalField<2>(rest_.shape.size())};
        std::vector<double>     unknowns(system_.n_unknowns(), 0.);
        EXPECT_TRUE(system_.solve({rest_, at_rest, slope_weight, 0., 0., &known}, unknowns));
        std::vector<Eigen::Triplet<Complex>> entries;
        for (PetscInt row = 0; row < solver_.size(); ++row)
        {
          PetscInt           n;
          const PetscInt    *columns;
          const PetscScalar *values;
          MatGetRow(solver_.matrix(), row, &n, &columns, &values);
          for (PetscInt k = 0; k < n; ++k)
            entries.emplace_back(row, columns[k], values[k]);
          MatRestoreRow(solver_.matrix(), row, &n, &columns, &values);
        }
        ComplexMatrix matrix(system_.n_unknowns(), system_.n_unknowns());
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
      }

      /// To the torque of the field's amplitude on the head, which is the last unknown.
      Amplitudes solve(const ComplexMatrix &matrix) const
      {
        const Scene     &scene = swimmer_.scene();
        Eigen::VectorXcd load  = Eigen::VectorXcd::Zero(matrix.rows());
        load[load.size() - 1] =
            swimmer_.torque_on_head({0.}, .25 * scene.field.period_s()).torque[0] / scene.body_length_m();
        const Eigen::SparseLU<ComplexMatrix> factors(matrix);
        EXPECT_EQ(factors.info(), Eigen::Success);
        const Eigen::VectorXcd    solution = factors.solve(load);
        const std::vector<double> real(solution.real().begin(), solution.real().end()),
            imaginary(solution.imag().begin(), solution.imag().end());
        const auto         a = system_.velocities(real), b = system_.velocities(imaginary);
        const unsigned int tip = swimmer_.tail().axis_at_tip[2];
        const Complex      head(a.head_velocity[1], b.head_velocity[1]);
        return {{a.head_omega[0], b.head_omega[0]}, head, Complex(a.tail[tip][1], b.tail[tip][1]) - head};
      }

      Swimmer<2>       swimmer_;
      Configuration<2> rest_ = swimmer_.configuration_at_rest();
      FluidDomain<2>   fluid_{swimmer_.scene(), mesh_around(swimmer_, rest_, MPI_COMM_WORLD), rest_.pose};
      LinearSystem     solver_{MPI_COMM_WORLD, {.tolerance = 1e-12}};
      CoupledSystem<2> system_{swimmer_, &fluid_, solver_, MPI_COMM_WORLD};
    };

    /// First harmonic in the last period of the time integration; the field is the imaginary part of e^{iwt}.
    Amplitudes amplitudes_in_time(const Scene &scene)
    {
      FullOrderModel<2>  model(scene, MPI_COMM_WORLD);
      Amplitudes         sum{};
      const unsigned int tip = model.swimmer().tail().axis_at_tip[2];
      const int          n = scene.time.steps_per_period, start = scene.time.n_steps() - n;
      for (int step = 1; step <= scene.time.n_steps(); ++step)
      {
        model.advance();
        if (step <= start)
          continue;
        const Rates<2> &rates  = model.now().rates;
        const Complex   factor = Complex(0., 2. / n) * std::polar(1., -2. * std::numbers::pi * step / n);
        sum.omega += factor * rates.omega[0];
        sum.head += factor * rates.velocity[1];
        sum.tip += factor * rates.shape_rate[tip][1];
      }
      return sum;
    }

    Scene scene_of(const std::string &viscosity_Pa_s, const int n_periods)
    {
      return shipped_scene("reference-2d-casefile",
                           {"fluid.inertia=full", "fluid.viscosity_Pa_s=" + viscosity_Pa_s,
                            "field.by_T=1e-6", // of a bias of 5e-3
                            "numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                            "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.6",
                            "numerics.coupling_tolerance=1e-12", "numerics.linear_tolerance=1e-12",
                            "time.steps_per_period=200", "time.periods=" + std::to_string(n_periods)});
    }

    /// e^{st} with the rate that BDF2 takes it to have.
    Complex rate_of_bdf2(const Complex s, const double dt)
    {
      const Complex back = std::exp(-s * dt);
      return (1.5 - 2. * back + .5 * back * back) / dt;
    }

    /// Once the start is forgotten, after so many periods.
    void expect_linear(const std::string &viscosity_Pa_s, const int n_periods)
    {
      const Scene      scene = scene_of(viscosity_Pa_s, n_periods);
      LinearSwimmer    swimmer(scene);
      const Complex    s(0., 2. * std::numbers::pi / scene.field.period_s());
      const Amplitudes in_time = amplitudes_in_time(scene), exact = swimmer.respond(s),
                       of_steps = swimmer.respond(rate_of_bdf2(s, scene.time.time_step_s()));
      std::cout << "small field, " << viscosity_Pa_s << " Pa s: phases " << std::arg(exact.omega) << ", "
                << std::arg(exact.head) << ", " << std::arg(exact.tip) << "; off by "
                << largest_deviation(in_time, exact) << ", by " << largest_deviation(in_time, of_steps)
                << " from what BDF2 should give" << std::endl;
      EXPECT_LE(largest_deviation(in_time, exact), 1e-3);
      // What is left is the square of the angle, 4e-8, and of the start.
      EXPECT_LE(largest_deviation(in_time, of_steps), 1e-6);
    }
  } // namespace

  // Unsteady groups 0.3 and 3.
  TEST(SmallField, MotionIsThatOfOneComplexSolve)
  {
    expect_linear("1.52", 5);
    expect_linear("0.15", 4);
  }
} // namespace swimtwin
