#include <tests/twin/filter/textbook_filter.h>
#include <twin/filter/smoother.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    TEST(Smoother, EqualsTheTextbookOnALinearProblem)
    {
      const auto    frames = toy_frames(60, 1);
      LinearProcess process;
      LinearSensor  sensor;
      WindowFilter  filter(process, sensor, plain_options());
      filter.start(0., toy_prior());
      for (const Frame &frame : frames)
        filter.add(frame);
      const auto beliefs    = smoothed_beliefs(filter);
      const auto textbook   = textbook_filter(frames);
      int        n_compared = 0;
      for (int i = 0; i < filter.n_nodes(); ++i) // nodes of divided steps lie between
        for (const TextbookStep &step : textbook)
          if (step.time_s == filter.node(i).time_s)
          {
            const Belief &belief = beliefs[static_cast<std::size_t>(i)];
            EXPECT_LT((belief.mean - step.smoothed).norm(), 1e-12);
            EXPECT_LT((belief.covariance() - step.P_smoothed).norm(), 1e-12);
            ++n_compared;
          }
      EXPECT_EQ(n_compared, 60);
      EXPECT_GT(filter.n_nodes(), 61);
    }
  } // namespace
} // namespace swimtwin
