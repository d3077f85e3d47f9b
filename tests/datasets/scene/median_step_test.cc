#include <datasets/scene/median_step.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  TEST(MedianStep, IsTheStepOfEvenInstantsWhereverTheyBegin)
  {
    EXPECT_DOUBLE_EQ(median_step({0., 0.25, 0.5, 0.75}), 0.25);
    EXPECT_DOUBLE_EQ(median_step({-2., -1.75, -1.5}), 0.25);
    EXPECT_EQ(median_step({3., 5.}), 2.);
  }

  TEST(MedianStep, DoesNotCareForAGapOrADoubledFrame)
  {
    EXPECT_DOUBLE_EQ(median_step({0., 1., 2., 100., 101., 102.}), 1.);
    EXPECT_DOUBLE_EQ(median_step({0., 1., 2., 2., 3., 4.}), 1.);
  }
} // namespace swimtwin
