#include <fom/fluid/fluid_inertia.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    using Load = std::array<double, n_fluid_cell_dofs<2>>;

    /// A triangle with curved sides.
    std::array<Point<2>, 6> curved_cell()
    {
      return {Point<2>(0., 0.),   Point<2>(1., .1),   Point<2>(.2, .9),
              Point<2>(.5, -.05), Point<2>(.65, .55), Point<2>(.05, .4)};
    }

    class FluidInertiaTest : public ::testing::Test
    {
    protected:
      FluidInertiaTest()
      {
        cell.reinit(curved_cell());
        for (unsigned int a = 0; a < 6; ++a)
          for (int i = 0; i < 2; ++i)
          {
            flow.fluid[a][i] = std::sin(1. + 3. * a + i);
            flow.known[a][i] = std::cos(2. + a - 2. * i);
            flow.mesh[a][i]  = .3 * std::sin(4. * a + i);
          }
      }

      Load force(const CellFlow<2> &at) const
      {
        Load          result{};
        KineticPowers powers;
        add_inertial_forces<2>(cell, inertia, at, result, powers);
        return result;
      }

      /// K u - load at the iterate is the force there.
      void expect_the_force(const FluidCellMatrix<2> &K, const Load &load) const
      {
        const Load here = force(flow);
        for (unsigned int row = 0; row < 12; ++row)
        {
          double linear = -load[row];
          for (unsigned int column = 0; column < 12; ++column)
            linear += K[row][column] * flow.fluid[column / 2][column % 2];
          EXPECT_NEAR(linear, here[row], 1e-13);
        }
      }

      IsoparametricCell<2> cell;
      FluidInertia         inertia{.density_kg_m3 = 1.7, .rate_1_s = 2.3, .is_convective = true};
      CellFlow<2>          flow;
    };

    // A uniform stream stays one however the mesh moves: no force, on any cell.
    TEST_F(FluidInertiaTest, AUniformStreamIsNotHeld)
    {
      const Tensor<1, 2> stream({1.3, -.7});
      flow.fluid.fill(stream);
      flow.known.fill(stream);
      for (const double f : force(flow))
        EXPECT_NEAR(f, 0., 1e-14);
    }

    // The linearised terms are the forces and their derivative: K u - load = force at the iterate, K = dforce/du.
    TEST_F(FluidInertiaTest, LinearisesItsForces)
    {
      FluidCellMatrix<2> K{};
      Load               load{};
      add_unsteady_term<2>(cell, inertia, flow, K, load);
      add_linearized_convection<2>(cell, inertia, flow, K, load);
      expect_the_force(K, load);
      constexpr double h = 1e-6;
      for (unsigned int column = 0; column < 12; ++column)
      {
        CellFlow<2> more = flow, less = flow;
        more.fluid[column / 2][column % 2] += h;
        less.fluid[column / 2][column % 2] -= h;
        const Load above = force(more), below = force(less);
        for (unsigned int row = 0; row < 12; ++row)
          EXPECT_NEAR(K[row][column], (above[row] - below[row]) / (2. * h), 1e-8);
      }
    }

    TEST_F(FluidInertiaTest, TakenFromTheIterateIsTheSameForce)
    {
      FluidCellMatrix<2> K{};
      Load               load{};
      add_unsteady_term<2>(cell, inertia, flow, K, load);
      add_convection_as_load<2>(cell, inertia, flow, load);
      expect_the_force(K, load);
    }

    // Nodes that go with the fluid carry nothing past them, whatever the solution: their columns have no reaction.
    TEST_F(FluidInertiaTest, NothingPassesNodesThatGoWithTheFluid)
    {
      for (const unsigned int a : {0u, 1u, 3u})
      {
        flow.goes_with_fluid[a] = true;
        flow.mesh[a]            = flow.fluid[a];
      }
      FluidCellMatrix<2> K{};
      Load               load{};
      add_linearized_convection<2>(cell, inertia, flow, K, load);
      constexpr double h = 1e-6;
      for (unsigned int column = 0; column < 12; ++column)
      {
        const auto move = [&](const double step) {
          CellFlow<2> moved = flow;
          moved.fluid[column / 2][column % 2] += step;
          if (flow.goes_with_fluid[column / 2])
            moved.mesh[column / 2] = moved.fluid[column / 2];
          moved.known = moved.fluid; // without the unsteady term
          return force(moved);
        };
        const Load above = move(h), below = move(-h);
        for (unsigned int row = 0; row < 12; ++row)
          EXPECT_NEAR(K[row][column], (above[row] - below[row]) / (2. * h), 1e-8);
      }
    }

    // Power of all inertial forces = growth + outflow: what is not stored has left.
    TEST_F(FluidInertiaTest, PowersAddUp)
    {
      Load          f{};
      KineticPowers powers;
      add_inertial_forces<2>(cell, inertia, flow, f, powers);
      double power = 0.;
      for (unsigned int i = 0; i < 12; ++i)
        power += f[i] * flow.fluid[i / 2][i % 2];
      EXPECT_NEAR(power, powers.growth + powers.outflow, 1e-13);
    }
  } // namespace
} // namespace swimtwin
