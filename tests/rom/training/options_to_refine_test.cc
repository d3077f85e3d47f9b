#include <rom/training/training_options.h>

#include <datasets/reduced/reduced_model.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace swimtwin
{
  namespace
  {
    ReducedModel shipped()
    {
      return read_reduced_model(std::filesystem::path(places::models) / "open-2d.h5");
    }
  } // namespace

  TEST(OptionsToRefine, AreThoseThatTheModelWasMadeWith)
  {
    const ReducedModel    model   = shipped();
    const TrainingOptions options = options_to_refine(model);
    EXPECT_EQ(options.n_coordinates, model.n_modes());
    EXPECT_EQ(options.n_samples, model.record.n_resistance_samples);
    EXPECT_EQ(options.range.frequency_Hz.high, model.range.frequency_Hz.high);
    EXPECT_EQ(options.range.young_modulus_Pa.low, model.range.young_modulus_Pa.low);
    EXPECT_GT(options.target, 0.);
  }

  // Runs that are known are not made again, however many an untold training makes.
  TEST(OptionsToRefine, CompareWithTheRunsThatTheModelKnows)
  {
    ReducedModel model = shipped();
    ASSERT_FALSE(model.record.held_out_runs.empty());
    EXPECT_EQ(options_to_refine(model).known_runs.size(), model.record.held_out_runs.size());
    EXPECT_EQ(options_to_refine(model).n_held_out, static_cast<int>(model.record.held_out_runs.size()));
    model.record.held_out_runs.clear();
    EXPECT_EQ(options_to_refine(model).n_held_out, 0);
  }

  // Models of earlier versions did not write down what they aimed at, or how many samples they had.
  TEST(OptionsToRefine, FallBackOnTheUsualOnes)
  {
    ReducedModel model                = shipped();
    model.record.target               = 0.;
    model.record.n_resistance_samples = 0;
    EXPECT_EQ(options_to_refine(model).target, TrainingOptions().target);
    EXPECT_EQ(options_to_refine(model).n_samples, TrainingOptions().n_samples);
    model.record.target = 0.02;
    EXPECT_EQ(options_to_refine(model).target, 0.02);
  }
} // namespace swimtwin
