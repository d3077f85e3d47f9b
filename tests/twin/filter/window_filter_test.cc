#include <tests/twin/filter/textbook_filter.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr double round_off = 1e-12;

    struct ToyFilter
    {
      LinearProcess process;
      LinearSensor  sensor;
      WindowFilter  filter;
      explicit ToyFilter(const FilterOptions &options = plain_options()) : filter(process, sensor, options)
      {
        filter.start(0., toy_prior());
      }
      void add_all(const std::vector<Frame> &frames)
      {
        for (const Frame &frame : frames)
          ASSERT_NE(filter.add(frame), Insertion::too_old);
      }
    };

    void expect_same(const Belief &a, const Belief &b, const double tolerance)
    {
      EXPECT_LT((a.mean - b.mean).norm(), tolerance);
      EXPECT_LT((a.root - b.root).norm(), tolerance);
    }

    TEST(WindowFilter, EqualsTheTextbookOnALinearProblem)
    {
      const auto frames = toy_frames(60, 1);
      ToyFilter  toy;
      toy.add_all(frames);
      const TextbookStep end = textbook_filter(frames).back();
      EXPECT_LT((toy.filter.latest().filtered.mean - end.filtered).norm(), round_off);
      EXPECT_LT((toy.filter.latest().filtered.covariance() - end.P_filtered).norm(), round_off);
    }

    TEST(WindowFilter, EndsInTheSameStateWhenWhatWasSeenComesLateAndShuffled)
    {
      const auto frames = toy_frames(60, 2);
      ToyFilter  ordered, shuffled;
      ordered.add_all(frames);
      auto         late = frames;
      std::mt19937 engine(5);
      for (std::size_t i = 0; i + 10 <= late.size(); i += 10)
        std::shuffle(late.begin() + static_cast<long>(i), late.begin() + static_cast<long>(i) + 10, engine);
      shuffled.add_all(late);
      EXPECT_EQ(ordered.filter.latest().filtered.mean, shuffled.filter.latest().filtered.mean);
      EXPECT_EQ(ordered.filter.latest().filtered.root, shuffled.filter.latest().filtered.root);
    }

    TEST(WindowFilter, EndsInTheSameStateWithAShortWindowAsLongAsNothingIsOlder)
    {
      const auto frames = toy_frames(200, 3);
      ToyFilter  ordered, late(plain_options(0.5));
      ordered.add_all(frames);
      auto delayed = frames;
      for (std::size_t i = 0; i + 3 < delayed.size(); i += 4)
        std::swap(delayed[i], delayed[i + 3]); // by at most 0.36 s
      late.add_all(delayed);
      EXPECT_LT(late.filter.n_nodes(), 30);
      expect_same(ordered.filter.latest().filtered, late.filter.latest().filtered, round_off);
    }

    TEST(WindowFilter, TakesPartsOfOneInstantInAnyOrder)
    {
      Frame     whole{0.5, {{0, {0.1, 0.4}, 0.2, 0.}, {1, {0.2, 0.1}, 0.3, 1.}}};
      ToyFilter together, apart;
      together.add_all({whole});
      apart.add_all({{0.5, {whole.observations[1]}}, {0.5, {whole.observations[0]}}});
      EXPECT_EQ(together.filter.latest().filtered.mean, apart.filter.latest().filtered.mean);
    }

    TEST(WindowFilter, RefusesWhatIsOlderThanItsWindow)
    {
      ToyFilter toy(plain_options(0.5));
      toy.add_all(toy_frames(50, 4));
      const Belief before = toy.filter.latest().filtered;
      EXPECT_EQ(toy.filter.add({0.01, {{0, {9., 9.}, 0.2, 0.}}}), Insertion::too_old);
      EXPECT_EQ(before.mean, toy.filter.latest().filtered.mean);
    }

    TEST(WindowFilter, LearnsTheNoiseThatNobodyStated)
    {
      auto frames = toy_frames(2000, 6);
      for (Frame &frame : frames)
        frame.observations.front().sigma = 0.;
      ToyFilter toy(plain_options(1.));
      toy.filter.options.robustness = {3., 5.};
      for (std::size_t i = 0; i < frames.size(); ++i)
        toy.filter.add(frames[i]);
      // The running mean over 200 of them has a relative standard deviation of 5 %.
      EXPECT_NEAR(toy.filter.latest().noise_levels[0].sigma(), 0.2, 0.04);
    }

    TEST(WindowFilter, IsNotMovedByAnOutlierBeyondTheGate)
    {
      ToyFilter toy;
      toy.filter.options.robustness = {3., 5.};
      toy.add_all(toy_frames(40, 7));
      Belief expected;
      ASSERT_TRUE(toy.filter.predict(toy.filter.latest().time_s + 0.05, expected));
      toy.filter.add({toy.filter.latest().time_s + 0.05, {{0, {7., 3.}, 0.2, 0.}}});
      EXPECT_EQ(toy.filter.latest().innovations.front().weight, 0.);
      expect_same(toy.filter.latest().filtered, expected, round_off);
    }

    TEST(WindowFilter, KeepsNoMoreThanItsWindow)
    {
      ToyFilter toy(plain_options(1.));
      toy.add_all(toy_frames(400, 8));
      EXPECT_LE(toy.filter.n_nodes(), 40);
    }
  } // namespace
} // namespace swimtwin
