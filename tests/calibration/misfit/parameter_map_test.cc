#include <tests/calibration/central_difference.h>
#include <tests/calibration/synthetic_curve.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    Eigen::VectorXd recording_quantities(const CalibratedSwimmer &s)
    {
      Eigen::VectorXd q(static_cast<Eigen::Index>(n_recording_quantities));
      q << std::log(s.young_modulus_Pa), std::log(s.viscosity_Pa_s), std::log(s.magnetization_A_m),
          std::log(s.field_scale), std::log(s.geometry_scale), std::log(s.displacement_scale), s.displacement_offset_m;
      return q;
    }

    ParameterMap map_of(const CalibrationProblem &problem)
    {
      return {problem, reference_swimmer().nominal, 1e-4};
    }
  } // namespace

  TEST(ParameterMap, SlopesAreDerivatives)
  {
    const ParameterMap    map = map_of(everything_free());
    const Eigen::VectorXd x   = somewhere(map, 0);
    for (int j = 0; j < map.size(); ++j)
    {
      const auto quantities = [&](const double step) {
        return recording_quantities(map.swimmer(x + step * Eigen::VectorXd::Unit(map.size(), j)));
      };
      const Eigen::VectorXd difference = central_difference(quantities, 1e-3);
      EXPECT_LT((difference - map.slopes(x).col(j)).cwiseAbs().maxCoeff(), 1e-11)
          << map.names()[static_cast<std::size_t>(j)];
      EXPECT_NEAR(central_difference([&](const double step) { return map.value(j, x[j] + step); }, 1e-3),
                  map.value_slope(j, x[j]), 1e-10 * std::abs(map.value_slope(j, x[j])));
    }
  }

  TEST(ParameterMap, IsUndoneByReadingTheSwimmer)
  {
    const ParameterMap      map     = map_of(everything_free());
    const Eigen::VectorXd   x       = somewhere(map, 0);
    const CalibratedSwimmer swimmer = map.swimmer(x);
    for (int j = 0; j < map.size(); ++j)
    {
      const double value = value_of(map.free()[static_cast<std::size_t>(j)].quantity, swimmer);
      EXPECT_NEAR(value, map.values(x)[j], 1e-14 * std::abs(value));
      EXPECT_NEAR(map.scaled(j, value), x[j], 1e-13);
    }
  }

  TEST(ParameterMap, DoesNotCareForTheOrderOfTheParameters)
  {
    CalibrationProblem    problem = everything_free();
    const Eigen::VectorXd x       = somewhere(map_of(problem), 0);
    std::reverse(problem.free.begin(), problem.free.end()); // a ratio before the viscosity that it refers to, or after
    EXPECT_TRUE(recording_quantities(map_of(problem).swimmer(x.reverse()))
                    .isApprox(recording_quantities(map_of(everything_free()).swimmer(x)), 1e-15));
  }

  TEST(ParameterMap, StartsAtTheNominalSwimmerMovedIntoTheBounds)
  {
    CalibrationProblem problem      = everything_free();
    problem.free[3].lower           = 1.2; // field_scale is 1 in the scene
    const ParameterMap      map     = map_of(problem);
    const CalibratedSwimmer nominal = reference_swimmer().nominal, start = map.swimmer(map.nominal());
    EXPECT_NEAR(start.viscosity_Pa_s, nominal.viscosity_Pa_s, 1e-14);
    EXPECT_NEAR(start.young_modulus_Pa, nominal.young_modulus_Pa, 1e-9);
    EXPECT_NEAR(start.field_scale, 1.2, 1e-14);
    EXPECT_TRUE((map.nominal().array() >= map.lower().array()).all());
    EXPECT_TRUE((map.nominal().array() <= map.upper().array()).all());
  }

  TEST(ParameterMap, AGivenRatioFollowsTheViscosity)
  {
    CalibrationProblem problem;
    problem.free  = {free_parameter(FittedQuantity::viscosity, 1., 2.)};
    problem.given = {{FittedQuantity::young_modulus_over_viscosity, 5e4}};
    const ParameterMap    map(problem, reference_swimmer().nominal, 1e-4);
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, std::log(1.3));
    EXPECT_NEAR(map.swimmer(x).young_modulus_Pa, 6.5e4, 1e-8);
    EXPECT_EQ(map.slopes(x)(by_young_modulus, 0), 1.);
  }

  TEST(ParameterMap, TheGroupBoxHoldsEverySwimmerWithinTheBoundsAndTouchesThem)
  {
    const ParameterMap    map = map_of(everything_free());
    const MotionGroups    groups(reference_swimmer());
    const Eigen::VectorXd lower = map.lower(), upper = map.upper();
    const GroupBox        box    = map.group_box(groups, lower, upper);
    Eigen::VectorXd       lowest = box.upper, highest = box.lower;
    for (int corner = 0; corner < 1 << map.size(); ++corner) // groups are monotone: corners are the extremes
    {
      Eigen::VectorXd x = lower;
      for (int j = 0; j < map.size(); ++j)
        if ((corner >> j) % 2 != 0)
          x[j] = upper[j];
      const Eigen::VectorXd g = groups.values(map.swimmer(x));
      lowest                  = lowest.cwiseMin(g);
      highest                 = highest.cwiseMax(g);
    }
    EXPECT_LT((lowest - box.lower).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((highest - box.upper).cwiseAbs().maxCoeff(), 1e-12);
  }

  TEST(ParameterMap, PriorsAreThoseOfTheScaledVariables)
  {
    const ParameterMap map = map_of(everything_free());
    EXPECT_FALSE(map.has_prior(0));
    EXPECT_TRUE(std::isinf(map.prior_standard_deviation(0)));
    EXPECT_NEAR(map.prior_mean(1), std::log(1.5), 1e-15); // of a logarithm: relative
    EXPECT_NEAR(map.prior_standard_deviation(1), 0.1 / 1.5, 1e-15);
    EXPECT_NEAR(map.prior_mean(6), 1e-6 / 1e-4, 1e-15); // of an offset: over the displacement
    EXPECT_NEAR(map.prior_standard_deviation(6), 1e-5 / 1e-4, 1e-15);
  }

  TEST(ParameterMap, NeedsTheDerivativesThatItsParametersChange)
  {
    using enum FittedQuantity;
    CalibrationProblem problem;
    problem.free      = {free_parameter(viscosity, 1., 2.)};
    const auto needed = map_of(problem).needed();
    EXPECT_TRUE(needed[by_viscosity]);
    EXPECT_FALSE(needed[by_young_modulus]);
    problem.given = {{young_modulus_over_viscosity, 5e4}}; // then the stiffness follows
    EXPECT_TRUE(map_of(problem).needed()[by_young_modulus]);
  }
} // namespace swimtwin
