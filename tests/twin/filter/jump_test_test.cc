#include <tests/twin/filter/linear_toy.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    const std::vector<JumpHypothesis> toy_hypotheses = {{"position", Eigen::Vector2d(1., 0.)},
                                                        {"speed", Eigen::Vector2d(0., 1.)}};

    /// Frames of the toy, to which a jump of the position is added from an instant on.
    JumpTest watched(const double jump_at_s, const double size, const unsigned int seed)
    {
      auto frames = toy_frames(200, seed);
      for (Frame &frame : frames)
        if (frame.time_s > jump_at_s)
          frame.observations.front().value += size * Eigen::Vector2d(1., 0.5);
      LinearProcess process;
      LinearSensor  sensor;
      FilterOptions options = plain_options(2.);
      options.learns_jumps  = true;
      WindowFilter filter(process, sensor, options);
      filter.start(0., toy_prior(), JumpTest(toy_hypotheses, 0.5, 8));
      for (const Frame &frame : frames)
        if (frame.time_s < jump_at_s + 2.)
          filter.add(frame);
      return filter.latest().jumps;
    }

    TEST(JumpTest, NamesWhatJumpedAndWhenAndHowFar)
    {
      const auto finding = watched(8., 1., 11).most_likely();
      ASSERT_TRUE(finding);
      EXPECT_EQ(finding->hypothesis, 0);
      EXPECT_NEAR(finding->since_s, 8., 0.5);
      EXPECT_NEAR(finding->size, 1., 4. * finding->standard_deviation);
      EXPECT_GT(finding->ratio, 30.);
    }

    TEST(JumpTest, IsQuietWhenNothingHappened)
    {
      for (unsigned int seed = 20; seed < 30; ++seed)
        EXPECT_LT(watched(8., 0., seed).most_likely()->ratio, 20.);
    }

    TEST(JumpTest, KnowsNothingAfterARestart)
    {
      JumpTest test = watched(8., 1., 11);
      test.restart();
      EXPECT_FALSE(test.most_likely());
    }
  } // namespace
} // namespace swimtwin
