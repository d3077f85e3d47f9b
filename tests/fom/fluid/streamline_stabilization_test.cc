#include <fom/fluid/streamline_stabilization.h>

#include <tests/observed_order.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr double slippery_Pa_s = 1e-6;

    std::array<Point<2>, 6> straight_cell(const double size)
    {
      const Point<2> a(.1, .2), b = a + size * Tensor<1, 2>({1., .1}), c = a + size * Tensor<1, 2>({.2, .9});
      return {a, b, c, a + (b - a) / 2., b + (c - b) / 2., a + (c - a) / 2.};
    }

    class StreamlineStabilizationTest : public ::testing::Test
    {
    protected:
      StreamlineStabilizationTest()
      {
        take(1., [](const Point<2> &) { return Tensor<1, 2>({.3, .8}); });
      }

      template <typename Flow>
      void take(const double size, const Flow &velocity)
      {
        const auto x = straight_cell(size);
        cell.reinit(x);
        for (unsigned int a = 0; a < 6; ++a)
          flow.fluid[a] = velocity(x[a]);
      }

      auto stabilization(const double viscosity_Pa_s = slippery_Pa_s) const
      {
        return StreamlineStabilization<2>::of(cell, inertia, flow, viscosity_Pa_s);
      }

      double power() const
      {
        std::array<double, n_fluid_cell_dofs<2>> force{};
        return stabilization()->add_forces(cell, flow, force);
      }

      static Tensor<1, 2> vortices(const Point<2> &x)
      {
        return Tensor<1, 2>({std::sin(x[0] + .5) * std::cos(x[1] + .3), -std::cos(x[0] + .5) * std::sin(x[1] + .3)});
      }

      IsoparametricCell<2> cell;
      FluidInertia         inertia{.density_kg_m3 = 1.7, .rate_1_s = 2.3, .is_convective = true};
      CellFlow<2>          flow;
    };

    TEST_F(StreamlineStabilizationTest, IsOffWhereTheCellResolvesTheFlow)
    {
      EXPECT_TRUE(stabilization());
      EXPECT_FALSE(stabilization(.1));
      inertia.is_convective = false; // the mesh alone carries nothing here
      EXPECT_FALSE(stabilization());
    }

    // It begins with nothing: a flow near the bound does not feel on which side it is.
    TEST_F(StreamlineStabilizationTest, BeginsWithNothing)
    {
      take(1., vortices);
      double below = 1e-6, above = 1.;
      for (int i = 0; i < 60; ++i)
        (stabilization((below + above) / 2.) ? below : above) = (below + above) / 2.;
      std::array<double, n_fluid_cell_dofs<2>> force{};
      EXPECT_NEAR(stabilization(below)->add_forces(cell, flow, force) / power(), 0., 1e-12);
    }

    TEST_F(StreamlineStabilizationTest, IsOffWhereTheMeshGoesWithTheFluid)
    {
      flow.mesh = flow.fluid;
      EXPECT_FALSE(stabilization());
    }

    TEST_F(StreamlineStabilizationTest, LeavesStreamsShearAndRotationAlone)
    {
      EXPECT_NEAR(power(), 0., 1e-14);
      take(1., [](const Point<2> &x) { return Tensor<1, 2>({.3 + 2. * x[1] - x[0], .8 + .5 * x[0] + x[1]}); });
      EXPECT_NEAR(power(), 0., 1e-13);
    }

    TEST_F(StreamlineStabilizationTest, IsSymmetricAndDissipates)
    {
      FluidCellMatrix<2> K{};
      stabilization()->add(cell, K);
      for (unsigned int seed = 0; seed < 20; ++seed)
      {
        double power = 0.;
        for (unsigned int i = 0; i < 12; ++i)
          for (unsigned int j = 0; j < 12; ++j)
          {
            EXPECT_DOUBLE_EQ(K[i][j], K[j][i]);
            power += K[i][j] * std::sin(1. + seed + 3. * i) * std::sin(1. + seed + 3. * j);
          }
        EXPECT_GT(power, 0.);
      }
    }

    TEST_F(StreamlineStabilizationTest, ForcesAreTheMatrixTimesTheFlow)
    {
      take(1., vortices);
      FluidCellMatrix<2> K{};
      stabilization()->add(cell, K);
      std::array<double, n_fluid_cell_dofs<2>> force{};
      double                                   power = -stabilization()->add_forces(cell, flow, force);
      for (unsigned int i = 0; i < 12; ++i)
      {
        double expected = 0.;
        for (unsigned int j = 0; j < 12; ++j)
          expected += K[i][j] * flow.fluid[j / 2][j % 2];
        EXPECT_NEAR(force[i], expected, 1e-14);
        power += force[i] * flow.fluid[i / 2][i % 2];
      }
      EXPECT_NEAR(power, 0., 1e-14);
    }

    // Per area: tau ~ h, variations ~ h.
    TEST_F(StreamlineStabilizationTest, PowerIsOfThirdOrderInTheCellsSize)
    {
      const auto density = [&](const double size) {
        take(size, vortices);
        return power() / (size * size);
      };
      EXPECT_NEAR(observed_order(density(.02), density(.01), 2.), 3., .05);
    }

    // In other units the forces are the same.
    TEST_F(StreamlineStabilizationTest, ScalesWithTheDensityAndTheSquareOfTheSpeed)
    {
      take(1., vortices);
      const double before = power();
      inertia.density_kg_m3 *= 3.;
      for (auto &u : flow.fluid)
        u *= 2.;
      EXPECT_NEAR(power() / before, 3. * 8., 1e-2); // the Reynolds number rises, too
    }
  } // namespace
} // namespace swimtwin
