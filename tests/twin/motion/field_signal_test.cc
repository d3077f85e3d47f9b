#include <twin/motion/field_signal.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    TEST(FieldSignal, PlaysWhatBeganLast)
    {
      FieldSignal field;
      EXPECT_EQ(field.value_T(1.), Eigen::Vector2d(0., 0.));
      field.play_sinusoid(2., 5e-3, 3e-3, 1.);
      EXPECT_EQ(field.value_T(1.), Eigen::Vector2d(0., 0.));
      EXPECT_NEAR(field.value_T(2.25).y(), 3e-3, 1e-12);
      field.add({3., {1e-3, 0.}, 1e-5});
      field.add({4., {2e-3, 1e-3}, 1e-5});
      EXPECT_NEAR(field.value_T(3.5).x(), 1.5e-3, 1e-12);
      EXPECT_EQ(field.sigma_T(3.5), 1e-5);
      EXPECT_EQ(field.frequency_Hz(3.5), 0.);
      EXPECT_EQ(field.value_T(9.), Eigen::Vector2d(2e-3, 1e-3));
      field.play_sinusoid(10., 1e-3, 0., 2.);
      EXPECT_EQ(field.value_T(10.1).x(), 1e-3);
      EXPECT_EQ(field.frequency_Hz(10.1), 2.);
    }

    TEST(FieldSignal, ReplacesWhatWasToCome)
    {
      FieldSignal field;
      field.replace({{0., {1e-3, 0.}}, {1., {1e-3, 0.}}, {2., {5e-3, 0.}}});
      // An instant that was added up in another way is the same one.
      field.replace({{1. + 1e-15, {2e-3, 0.}}, {1.5, {3e-3, 0.}}});
      EXPECT_EQ(field.samples().size(), 3U);
      EXPECT_NEAR(field.value_T(0.5).x(), 1.5e-3, 1e-12);
      EXPECT_NEAR(field.value_T(1.25).x(), 2.5e-3, 1e-12);
      EXPECT_EQ(field.value_T(9.).x(), 3e-3);
      field.replace({});
      EXPECT_EQ(field.samples().size(), 3U);
    }

    TEST(FieldSignal, TakesSamplesInAnyOrder)
    {
      FieldSignal a, b;
      for (const double t : {1., 2., 3., 4.})
        a.add({t, {t, t * t}});
      for (const double t : {3., 1., 4., 2., 2.})
        b.add({t, {t, t * t}});
      for (const double t : {0.5, 1.2, 2.7, 3.1, 5.})
        EXPECT_EQ(a.value_T(t), b.value_T(t));
    }

    TEST(FieldSignal, ForgetsNothingThatIsStillPlayed)
    {
      FieldSignal field;
      field.play_sinusoid(0., 1e-3, 1e-3, 1.);
      field.play_sinusoid(5., 2e-3, 1e-3, 1.);
      for (const double t : {6., 7., 8.})
        field.add({t, {t, 0.}});
      const Eigen::Vector2d before = field.value_T(7.5);
      field.forget_before(7.2);
      EXPECT_EQ(field.value_T(7.5), before);
      EXPECT_EQ(field.programs().size(), 1U);
      EXPECT_EQ(field.samples().size(), 2U);
    }
  } // namespace
} // namespace swimtwin
