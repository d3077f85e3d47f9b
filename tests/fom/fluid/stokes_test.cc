#include <fom/fluid/stokes.h>

#include <tests/fom/random_tensors.h>

#include <gtest/gtest.h>

#include <array>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    constexpr double viscosity = 1.7, pressure_scale = 3.;

    /// A triangle with one curved side.
    std::array<Point<2>, 6> curved_triangle()
    {
      return {{{0., 0.}, {1., 0.2}, {0.3, 0.9}, {0.5, 0.1}, {0.75, 0.68}, {0.15, 0.45}}};
    }

    class StokesCell : public ::testing::Test
    {
    protected:
      const std::array<Point<2>, 6> x = curved_triangle();
      IsoparametricCell<2>          cell;
      FluidCellMatrix<2>            K;
      double                        area = 0.;

      StokesCell()
      {
        cell.reinit(x);
        stokes_cell_matrix<2>(cell, viscosity, pressure_scale, K);
        for (unsigned int q = 0; q < cell.n_points(); ++q)
          area += cell.weight(q);
      }

      /// Local values of a velocity that is linear in x, no pressure.
      std::array<double, 15> linear_flow(const Tensor<2, 2> &gradient) const
      {
        std::array<double, 15> values{};
        for (unsigned int a = 0; a < 6; ++a)
          for (int c = 0; c < 2; ++c)
            values[2 * a + c] = gradient[c] * x[a] + 0.3;
        return values;
      }
      std::array<double, 15> times(const std::array<double, 15> &values) const
      {
        std::array<double, 15> result{};
        for (int i = 0; i < 15; ++i)
          for (int j = 0; j < 15; ++j)
            result[i] += K[i][j] * values[j];
        return result;
      }
      double power(const Tensor<2, 2> &gradient) const
      {
        const auto values = linear_flow(gradient), force = times(values);
        double     sum = 0.;
        for (int i = 0; i < 12; ++i)
          sum += values[i] * force[i];
        return sum;
      }
    };
    constexpr double rounding_of_sums = 1e-13; // of sums of some tens of terms of order one
  }                                            // namespace

  TEST_F(StokesCell, MatrixIsSymmetric)
  {
    for (int i = 0; i < 15; ++i)
      for (int j = 0; j < i; ++j)
        EXPECT_EQ(K[i][j], K[j][i]);
  }

  TEST_F(StokesCell, RigidMotionMeetsNoViscousForce)
  {
    Tensor<2, 2> turn;
    turn[0][1]       = -1.;
    turn[1][0]       = 1.;
    const auto force = times(linear_flow(turn));
    for (const double entry : force) // continuity rows too: it is free of divergence
      EXPECT_NEAR(entry, 0., rounding_of_sums);
  }

  // A grad u : grad v form would give 2 mu A for the stretch, mu A for the turn and the same for the shear.
  TEST_F(StokesCell, DissipationIsTwoMuTimesTheSquaredRateOfStrain)
  {
    Tensor<2, 2> stretch, shear;
    stretch[0][0] = 1.;
    stretch[1][1] = -1.;
    shear[0][1]   = 1.;
    EXPECT_NEAR(power(stretch), 4. * viscosity * area, rounding_of_sums);
    EXPECT_NEAR(power(shear), viscosity * area, rounding_of_sums);
    RandomNumbers random;
    const auto    H = random.matrix<2>(), D = .5 * (H + transpose(H));
    EXPECT_NEAR(power(H), 2. * viscosity * scalar_product(D, D) * area, rounding_of_sums);
  }

  TEST_F(StokesCell, PressureDoesWorkOnTheChangeOfVolume)
  {
    RandomNumbers          random;
    const Tensor<2, 2>     H = random.matrix<2>();
    std::array<double, 15> uniform_pressure{};
    uniform_pressure[12] = uniform_pressure[13] = uniform_pressure[14] = 1.;
    const auto force = times(uniform_pressure), flow = linear_flow(H);
    double     work = 0.;
    for (int i = 0; i < 12; ++i)
      work += force[i] * flow[i];
    EXPECT_NEAR(work, -pressure_scale * trace(H) * area, rounding_of_sums);
  }

  // Shape functions reproduce constants and positions, so this holds at every quadrature point.
  TEST_F(StokesCell, ForcesOfAnyFlowHaveNeitherResultantNorMoment)
  {
    RandomNumbers          random;
    std::array<double, 15> values;
    for (auto &value : values)
      value = random();
    const auto   force = times(values);
    Tensor<1, 2> resultant;
    double       moment = 0.;
    for (unsigned int a = 0; a < 6; ++a)
    {
      resultant += Tensor<1, 2>({force[2 * a], force[2 * a + 1]});
      moment += x[a][0] * force[2 * a + 1] - x[a][1] * force[2 * a];
    }
    EXPECT_LE(resultant.norm(), 100. * rounding_of_sums); // single forces are of order 100
    EXPECT_LE(std::abs(moment), 100. * rounding_of_sums);
  }
} // namespace swimtwin
