#include <reports/fit/fitted_quantity.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  TEST(FittedQuantity, HasASymbolAndAShortUnit)
  {
    EXPECT_EQ(shown_quantity("young_modulus_Pa", 8e4).label(), "E (kPa)");
    EXPECT_EQ(shown_quantity("young_modulus_over_viscosity_1_s", 52631.).label(), "E/μ (10³/s)");
    EXPECT_EQ(shown_quantity("magnetization_over_viscosity_A_m_Pa_s", 1.3e5).label(), "M/μ (kA/(m Pa s))");
    EXPECT_EQ(shown_quantity("viscosity_Pa_s", 1.52).label(), "μ (Pa s)");
    EXPECT_EQ(shown_quantity("displacement_offset_m", -3e-6).label(), "displacement offset (μm)");
    EXPECT_EQ(shown_quantity("field_scale", 1.01).label(), "field scale");
    EXPECT_EQ(shown_quantity("something_else", 1e9).label(), "something_else");
  }

  TEST(FittedQuantity, FactorBringsTheValueBelowAThousand)
  {
    EXPECT_DOUBLE_EQ(shown_quantity("young_modulus_Pa", 8e4).factor, 1e-3);
    EXPECT_DOUBLE_EQ(shown_quantity("young_modulus_Pa", 1000.).factor, 1e-3);
    EXPECT_DOUBLE_EQ(shown_quantity("young_modulus_Pa", 999.).factor, 1.);
    EXPECT_DOUBLE_EQ(shown_quantity("displacement_offset_m", 0.).factor, 1.);
    EXPECT_DOUBLE_EQ(shown_quantity("geometry_scale", 2e4).factor, 1.);
  }

  TEST(FittedQuantity, IntervalsSayWhatIsKnown)
  {
    const ShownQuantity kPa = shown_quantity("young_modulus_Pa", 8e4);
    EXPECT_EQ(interval_text({"profile", 78000., 82000., ""}, kPa), "78 to 82");
    EXPECT_EQ(interval_text({"profile", 78000., std::nullopt, ""}, kPa), "above 78");
    EXPECT_EQ(interval_text({"profile", std::nullopt, 82000., ""}, kPa), "below 82");
    EXPECT_EQ(interval_text({"profile", std::nullopt, std::nullopt, ""}, kPa), "not bounded");
    EXPECT_EQ(interval_text({}, kPa), "not computed");
    EXPECT_EQ(level_text(0.95), "95 %");
  }
} // namespace swimtwin
