#include <tests/stress/hard_swimmers.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    struct Entries
    {
      const char              *name;
      std::vector<std::string> settings;
    };

    void PrintTo(const Entries &entries, std::ostream *stream) // how GoogleTest names a case
    {
      *stream << entries.name;
    }

    class ExtremeValue : public testing::TestWithParam<Entries>
    {
    };

    class StepsPerPeriod : public testing::TestWithParam<int>
    {
    };

    Motion swim(const std::vector<std::string> &settings)
    {
      return expect_convergence(hard_swimmer(settings));
    }
  } // namespace

  TEST_P(ExtremeValue, IsSwumWithTheBalanceClosed)
  {
    swim(GetParam().settings);
  }

  const std::string neo_hookean = "tail.law=neo-hookean", no_inertia = "fluid.inertia=none";

  INSTANTIATE_TEST_SUITE_P(Reference, ExtremeValue,
                           testing::Values(Entries{"StiffnessOf100Pa", {"tail.young_modulus_Pa=1e2", neo_hookean}},
                                           Entries{"StiffnessOf10kPa", {"tail.young_modulus_Pa=1e4"}},
                                           Entries{"StiffnessOf100MPa", {"tail.young_modulus_Pa=1e8"}},
                                           Entries{"StiffnessOf1GPa", {"tail.young_modulus_Pa=1e9"}},
                                           Entries{"StiffnessOf1GPaNeoHookean",
                                                   {"tail.young_modulus_Pa=1e9", neo_hookean}},
                                           Entries{"ViscosityOfWater", {"fluid.viscosity_Pa_s=1e-3", no_inertia}},
                                           Entries{"ViscosityOf1000", {"fluid.viscosity_Pa_s=1e3"}},
                                           Entries{"Magnetization10MA", {"head.magnetization_A_m=1e7"}},
                                           Entries{"Frequency100Hz", {"field.frequency_Hz=100", no_inertia}},
                                           Entries{"NearlyIncompressibleTail", {"tail.poisson_ratio=0.499"}},
                                           Entries{"LinearTail", {"numerics.tail_order=1"}}),
                           [](const auto &test) { return test.param.name; });

  TEST_P(StepsPerPeriod, CloseTheBalanceToSecondOrder)
  {
    expect_convergence(hard_swimmer({}, GetParam()), GetParam());
  }

  INSTANTIATE_TEST_SUITE_P(Reference, StepsPerPeriod, testing::Values(10, 20, 40, 100, 400),
                           testing::PrintToStringParamName());

  // The limit of a stiff tail is a rigid one: tens of megapascals and a gigapascal swim alike, to the error of the
  // step.
  TEST(StiffTail, SwimsLikeAStifferOne)
  {
    const Motion stiff = swim({"tail.young_modulus_Pa=1e8"}), stiffer = swim({"tail.young_modulus_Pa=1e9"});
    EXPECT_LT(distance(stiff.trajectory, stiffer.trajectory), 1e-3);
  }

  TEST(NoField, LeavesTheSwimmerAtRest)
  {
    for (const char *setting : {"head.magnetization_A_m=0", "field.by_T=0"})
    {
      const Motion motion = swim({setting});
      for (const TrajectoryRow &row : motion.trajectory)
        EXPECT_LT(std::hypot(row.head_x_m, row.head_y_m), 1e-9 * body_length_m) << setting << " t = " << row.time_s;
    }
  }
} // namespace swimtwin
