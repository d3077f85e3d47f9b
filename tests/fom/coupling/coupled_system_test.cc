#include <fom/coupling/coupled_system.h>

#include <tests/fom/bent_swimmer.h>
#include <tests/fom/random_tensors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// One linear system of a step of 0.01 s.
    struct OneStep
    {
      BentSwimmer         bent;
      LinearSystem        solver{MPI_COMM_WORLD, {.tolerance = 1e-13}};
      CoupledSystem<2>    system{bent.swimmer, &bent.fluid, solver, MPI_COMM_WORLD};
      std::vector<double> unknowns = std::vector<double>(system.n_unknowns(), 0.);

      explicit OneStep(std::vector<std::string> settings = {}) : bent(std::move(settings))
      {
        EXPECT_TRUE(system.solve({bent.configuration, bent.rates, 0.01, time_s}, unknowns));
      }

      /// Force and torque about the head's centre of the body on the fluid.
      Tensor<1, 3> load_on_fluid() const
      {
        std::vector<double> rows = system.expand(unknowns);
        rows.resize(bent.fluid.n_rows());
        const auto   force = bent.fluid.force_on_fluid_at_surface(rows);
        const auto   x     = bent.swimmer.surface(bent.configuration);
        Tensor<1, 3> sum;
        for (unsigned int k = 0; k < x.size(); ++k)
        {
          const double fx = force[bent.fluid.surface_row(k, 0)], fy = force[bent.fluid.surface_row(k, 1)];
          const auto   r = x[k] - bent.configuration.pose.center;
          sum += Tensor<1, 3>({fx, fy, r[0] * fy - r[1] * fx});
        }
        return sum;
      }

      static constexpr double time_s = 0.1;
    };

    std::vector<double> random_vector(RandomNumbers &random, const unsigned int n)
    {
      std::vector<double> v(n);
      for (auto &entry : v)
        entry = random();
      return v;
    }
  } // namespace

  TEST(CoupledSystem, IterationsByBlocksGiveWhatFactorsGive)
  {
    const OneStep    factors;
    BentSwimmer      bent;
    LinearSystem     solver(MPI_COMM_WORLD, {.tolerance = 1e-11, .symmetric = true, .method = LinearSolver::iterative});
    CoupledSystem<2> system(bent.swimmer, &bent.fluid, solver, MPI_COMM_WORLD);
    std::vector<double> unknowns(system.n_unknowns(), 0.);
    ASSERT_TRUE(system.solve({bent.configuration, bent.rates, 0.01, OneStep::time_s}, unknowns));
    double largest = 0., off = 0.;
    for (std::size_t i = 0; i < unknowns.size(); ++i)
    {
      largest = std::max(largest, std::abs(factors.unknowns[i]));
      off     = std::max(off, std::abs(unknowns[i] - factors.unknowns[i]));
    }
    EXPECT_LT(off, 1e-7 * largest);
    EXPECT_LT(solver.counts().n_iterations, 100);
  }

  // Beside the head's rotation the tail's velocities are those of its shape, which alone its energy depends on.
  TEST(CoupledSystem, MatrixIsSymmetricHoweverTheTailIsStressed)
  {
    OneStep       step;
    RandomNumbers random;
    Vec           x, Ax, transposed;
    MatCreateVecs(step.solver.matrix(), &Ax, &x);
    VecDuplicate(Ax, &transposed);
    const auto values = random_vector(random, step.system.n_unknowns());
    for (unsigned int i = 0; i < values.size(); ++i)
      VecSetValue(x, i, values[i], INSERT_VALUES);
    VecAssemblyBegin(x);
    VecAssemblyEnd(x);
    MatMult(step.solver.matrix(), x, Ax);
    MatMultTranspose(step.solver.matrix(), x, transposed);
    double size, difference;
    VecNorm(Ax, NORM_INFINITY, &size);
    VecAXPY(transposed, -1., Ax);
    VecNorm(transposed, NORM_INFINITY, &difference);
    EXPECT_LE(difference, 1e-13 * size);
    VecDestroy(&x);
    VecDestroy(&Ax);
    VecDestroy(&transposed);
  }

  TEST(CoupledSystem, FluidCarriesTheMagneticTorqueAndNoForceWhateverTheStress)
  {
    OneStep     step;
    const auto  load                      = step.load_on_fluid();
    const auto &bent                      = step.bent;
    const auto [torque, derivative, axis] = bent.swimmer.torque_on_head(bent.configuration.pose, OneStep::time_s);
    const auto   v                        = step.system.velocities(step.unknowns);
    const double expected                 = (torque + 0.01 * derivative * (v.head_omega - bent.rates.omega))[0];
    EXPECT_NEAR(load[2], expected, 1e-9 * torque.norm());
    EXPECT_LE(std::abs(load[0]) + std::abs(load[1]), 1e-9 * torque.norm() / bent.scene.body_length_m());
  }

  TEST(CoupledSystem, FluidCarriesTheDeadLoadsOfTheTailAndTheirTorque)
  {
    OneStep step({"gravity.acceleration_m_s2=[0.0, -9.81]", "tail.density_kg_m3=2000.0", "head.density_kg_m3=1260.0"});
    const auto  &bent = step.bent;
    const auto   x    = bent.swimmer.tail_positions(bent.configuration);
    Tensor<1, 3> loads;
    for (unsigned int a = 0; a < x.size(); ++a)
    {
      const auto f = bent.swimmer.load_on_tail_node(a, OneStep::time_s);
      const auto r = x[a] - bent.configuration.pose.center;
      loads += Tensor<1, 3>({f[0], f[1], r[0] * f[1] - r[1] * f[0]});
    }
    const auto on_head                    = bent.swimmer.force_on_head(OneStep::time_s);
    const auto [torque, derivative, axis] = bent.swimmer.torque_on_head(bent.configuration.pose, OneStep::time_s);
    const auto v                          = step.system.velocities(step.unknowns);
    loads +=
        Tensor<1, 3>({on_head[0], on_head[1], (torque + 0.01 * derivative * (v.head_omega - bent.rates.omega))[0]});
    const auto on_fluid = step.load_on_fluid();
    EXPECT_GT(std::abs(loads[1]), 1e-6);
    EXPECT_LE((on_fluid - loads).norm(), 1e-9 * loads.norm());
    EXPECT_NEAR(on_fluid[2], loads[2], 1e-9 * loads.norm() * bent.scene.body_length_m());
  }

  // The surface moves as the body does, with what was left out of the tail's unknowns.
  TEST(CoupledSystem, SurfaceTurnsWithTheHead)
  {
    OneStep     step;
    const auto &bent  = step.bent;
    const auto  rows  = step.system.expand(step.unknowns);
    const auto  v     = step.system.velocities(step.unknowns);
    const auto  x     = bent.swimmer.surface(bent.configuration);
    double      error = 0., largest = 0.;
    for (unsigned int k = 0; k < x.size(); ++k)
      if (const int node = bent.swimmer.tail_node(k); node >= 0)
      {
        const Tensor<1, 2> w =
            v.tail[node] + rotational_velocity<2>(v.head_omega, x[k] - bent.configuration.pose.center);
        for (int c = 0; c < 2; ++c)
        {
          error   = std::max(error, std::abs(rows[bent.fluid.surface_row(k, c)] - w[c]));
          largest = std::max(largest, std::abs(w[c]));
        }
      }
    EXPECT_GT(largest, 0.);
    EXPECT_LE(error, 1e-13 * largest);
  }
} // namespace swimtwin
