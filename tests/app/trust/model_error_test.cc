#include <app/trust/model_error.h>

#include <datasets/system/error.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    ReducedModel off_by(const double share)
    {
      ReducedModel model = example_model();
      model.record.held_out_runs[0].reduced_displacement_m =
          (1. + share) * model.record.held_out_runs[0].displacement_m;
      return model;
    }

    std::string refusal(const ReducedModel &model)
    {
      try
      {
        require_borne_model_error(model, "swimmer.h5", false);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }
  } // namespace

  TEST(ModelError, AboveFivePercentIsRefusedUntilItIsAccepted)
  {
    const std::string sentence = refusal(off_by(.2));
    for (const char *part : {"swimmer.h5", "20 % (rms)", "more than the 5 %", "--modes", "--accept-model-error"})
      EXPECT_NE(sentence.find(part), std::string::npos) << part;
    EXPECT_NO_THROW(require_borne_model_error(off_by(.2), "swimmer.h5", true));
  }

  TEST(ModelError, OfAGoodModelAndOneThatDoesNotTellAreBorne)
  {
    EXPECT_EQ(refusal(off_by(.03)), "");
    ReducedModel silent = example_model();
    silent.record.held_out_runs.clear();
    EXPECT_EQ(refusal(silent), "");
  }
} // namespace swimtwin
