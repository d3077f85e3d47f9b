#include <rom/integration/prescribed_gait.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    /// Along a line in shape space, there and back.
    class ReciprocalGait : public Gait
    {
    public:
      explicit ReciprocalGait(ShapeVector amplitude) : amplitude_(std::move(amplitude)) {}
      ShapeVector shape_m(const double phase) const override { return std::sin(2. * pi * phase) * amplitude_; }
      ShapeVector rate_m(const double phase) const override { return 2. * pi * std::cos(2. * pi * phase) * amplitude_; }

    private:
      ShapeVector amplitude_;
    };

    /// Around a loop; `unevenness` (below 1 / 2 pi) makes the pace differ along it.
    class LoopGait : public Gait
    {
    public:
      LoopGait(ShapeVector cosine, ShapeVector sine, const double unevenness)
          : cosine_(std::move(cosine)), sine_(std::move(sine)), unevenness_(unevenness)
      {
      }
      ShapeVector shape_m(const double phase) const override
      {
        const double a = 2. * pi * place(phase);
        return std::cos(a) * cosine_ + std::sin(a) * sine_;
      }
      ShapeVector rate_m(const double phase) const override
      {
        const double a = 2. * pi * place(phase), pace = 1. + 2. * pi * unevenness_ * std::cos(2. * pi * phase);
        return 2. * pi * pace * (std::cos(a) * sine_ - std::sin(a) * cosine_);
      }

    private:
      double      place(const double phase) const { return phase + unevenness_ * std::sin(2. * pi * phase); }
      ShapeVector cosine_, sine_;
      double      unevenness_;
    };

    class Gaits : public ::testing::Test
    {
    protected:
      const ReducedModel   model   = example_model();
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      RandomNumbers        random  = RandomNumbers(5);
    };
  } // namespace

  TEST_F(Gaits, ReciprocalOnesReturnThePose)
  {
    for (int i = 0; i < 5; ++i)
    {
      const ReciprocalGait gait(random_shape(model, random, 0.9));
      const GaitRun        run = follow_gait(swimmer, gait, 0.3, 1, 1e-12);
      ASSERT_TRUE(run.completed) << run.failure;
      EXPECT_LE((run.at_period_end[1] - run.at_period_end[0]).head<2>().norm(), 1e-10 * swimmer.length_m());
      EXPECT_NEAR(run.at_period_end[1][2], 0.3, 1e-10);
    }
  }

  TEST_F(Gaits, LoopsMoveTheHeadWhateverThePace)
  {
    const ShapeVector a = random_shape(model, random, 0.7), b = random_shape(model, random, 0.7);
    const GaitRun     even   = follow_gait(swimmer, LoopGait(a, b, 0.), 0., 1, 1e-12);
    const GaitRun     uneven = follow_gait(swimmer, LoopGait(a, b, 0.12), 0., 1, 1e-12);
    ASSERT_TRUE(even.completed && uneven.completed);
    EXPECT_GT(even.at_period_end[1].head<2>().norm(), 1e-3 * swimmer.length_m());
    EXPECT_LE((even.at_period_end[1] - uneven.at_period_end[1]).head<2>().norm(), 1e-10 * swimmer.length_m());
  }
} // namespace swimtwin
