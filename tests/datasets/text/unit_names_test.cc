#include <datasets/text/unit_names.h>

#include <gtest/gtest.h>

#include <numbers>

namespace swimtwin
{
  namespace
  {
    double factor(const std::string_view from, const std::string_view to)
    {
      return unit_factor(from, to).value_or(0.);
    }
  } // namespace

  TEST(UnitNames, AreThoseOfPeopleAndPrograms)
  {
    for (const char *name :
         {"um", "\u00B5m", "\u03BCm", "micron", "Microns", "micrometer", "(micron)", "[um]", "micrometres"})
      EXPECT_DOUBLE_EQ(factor(name, "m"), 1e-6) << name;
    for (const char *name : {"s", "sec", "second", "seconds"})
      EXPECT_DOUBLE_EQ(factor(name, "s"), 1.) << name;
    EXPECT_DOUBLE_EQ(factor("ms", "s"), 1e-3);
    EXPECT_DOUBLE_EQ(factor("milliseconds", "s"), 1e-3);
    EXPECT_DOUBLE_EQ(factor("min", "s"), 60.);
    EXPECT_DOUBLE_EQ(factor("inch", "m"), 0.0254);
    EXPECT_DOUBLE_EQ(factor("cm", "mm"), 10.);
  }

  TEST(UnitNames, MayBeComposed)
  {
    EXPECT_DOUBLE_EQ(factor("mm/s", "m_s"), 1e-3);
    EXPECT_DOUBLE_EQ(factor("um_min", "m_s"), 1e-6 / 60.);
    EXPECT_DOUBLE_EQ(factor("mm per s", "m_s"), 1e-3);
    EXPECT_DOUBLE_EQ(factor("g_cm3", "kg_m3"), 1000.);
    EXPECT_DOUBLE_EQ(factor("kA_m", "A_m"), 1000.);
    EXPECT_DOUBLE_EQ(factor("mPa_s", "Pa_s"), 1e-3);
    EXPECT_DOUBLE_EQ(factor("cP", "Pa_s"), 1e-3);
    EXPECT_DOUBLE_EQ(factor("rad/s", "Hz"), 0.5 / std::numbers::pi);
    EXPECT_DOUBLE_EQ(factor("rpm", "Hz"), 1. / 60.);
  }

  TEST(UnitNames, ThatMeasureSomethingElseHaveNoFactor)
  {
    for (const char *name : {"s", "Hz", "px", "", "mmm", "MM", "furlong"})
      EXPECT_FALSE(unit_factor(name, "m")) << name;
    EXPECT_FALSE(unit_factor("mhz", "Hz")); // mega or milli?
    EXPECT_TRUE(is_pixel("(pixel)"));
    EXPECT_TRUE(is_pixel("px"));
    EXPECT_FALSE(is_pixel("um"));
  }

  TEST(UnitNames, EndTheNamesOfColumnsAndKeys)
  {
    EXPECT_DOUBLE_EQ(factor_between_names("displacement_mm", "displacement_m").value_or(0.), 1e-3);
    EXPECT_DOUBLE_EQ(factor_between_names("Mean speed (mm/s)", "mean_speed_m_s").value_or(0.), 1e-3);
    EXPECT_DOUBLE_EQ(factor_between_names("frequency_rad_s", "frequency_Hz").value_or(0.), 0.5 / std::numbers::pi);
    EXPECT_FALSE(factor_between_names("displacement", "displacement_m"));
    EXPECT_FALSE(factor_between_names("sigma_m_s", "sigma_m"));
    EXPECT_FALSE(factor_between_names("distance_mm", "displacement_m"));
  }

  TEST(UnitNames, AreRepairedWhereTheSignForMicroWasDamaged)
  {
    for (const char *name : {"\u00C2\u00B5m", "\u00E6m", "(?m)", "[\\u00B5m]", "&micro;m", "\uFFFDm", "\u00CE\u00BCm"})
      EXPECT_EQ(repaired_unit(name), "um") << name;
    EXPECT_EQ(repaired_unit("?m/s"), "um/s");
    for (const char *name : {"\u00B5m", "um", "m", "pixel", "furlong", "?", "??pixel", ""})
      EXPECT_FALSE(repaired_unit(name)) << name;
  }

  TEST(UnitNames, StandInNames)
  {
    EXPECT_EQ(reading_with_unit("mean_speed_mm_s")->stem, "mean_speed");
    EXPECT_EQ(reading_with_unit("Displ. [mm]")->unit, "mm");
    EXPECT_FALSE(reading_with_unit("displacement_px"));
    EXPECT_EQ(name_in_unit("displacement_m", "cm"), "displacement_cm");
    EXPECT_EQ(name_in_unit("mean_speed_m_s", "\u00B5m / s"), "mean_speed_um_s");
  }
} // namespace swimtwin
