#include <datasets/observation/calibration_problem.h>
#include <datasets/system/error.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    const std::string ratio = "[parameters.young_modulus_over_viscosity_1_s]\nbounds = [2e4, 2e5]\n";

    CalibrationProblem parse(const std::string &text)
    {
      return parse_calibration_problem(text, "fit.toml", "data");
    }

    void expect_refusal(const std::string &text, const std::string &part)
    {
      try
      {
        parse(text);
        ADD_FAILURE() << "accepted: " << text;
      }
      catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      }
    }
  } // namespace

  TEST(CalibrationProblem, ReadsEveryEntry)
  {
    const CalibrationProblem problem = parse(R"(
data = ["a.csv", "b.csv"]
[parameters.viscosity_Pa_s]
value = 1.4
[parameters.magnetization_A_m]
bounds = [1e5, 2e5]
scale = "linear"
start = 1.2e5
prior_mean = 1.3e5
prior_standard_deviation = 1e4
[parameters.displacement_offset_m]
bounds = [-1e-5, 1e-5]
[loss]
kind = "cauchy"
width_sigmas = 2.0
[fit]
starts = 7
seed = 3
method = "ccsaq"
max_evaluations = 50
allow_untrained = true
[uncertainty]
level = 0.9
profiles = false
bootstrap_samples = 11
model_error = 0.02
[next]
parameter = "magnetization_A_m"
lowest_frequency_Hz = 0.2
highest_frequency_Hz = 2
)");
    EXPECT_EQ(problem.data, (std::vector<std::filesystem::path>{"data/a.csv", "data/b.csv"}));
    ASSERT_EQ(problem.free.size(), 2u);
    EXPECT_EQ(problem.free[0].quantity, FittedQuantity::magnetization);
    EXPECT_FALSE(problem.free[0].logarithmic);
    EXPECT_EQ(problem.free[0].start, 1.2e5);
    EXPECT_EQ(problem.free[0].prior->standard_deviation, 1e4);
    EXPECT_FALSE(problem.free[1].logarithmic); // may be negative
    EXPECT_EQ(problem.given[0].value, 1.4);
    EXPECT_EQ(problem.loss, LossKind::cauchy);
    EXPECT_EQ(problem.loss_width, 2.);
    EXPECT_EQ(problem.n_starts, 7);
    EXPECT_EQ(problem.seed, 3);
    EXPECT_EQ(problem.method, "ccsaq");
    EXPECT_TRUE(problem.allow_untrained);
    EXPECT_EQ(problem.level, 0.9);
    EXPECT_FALSE(problem.profiles);
    EXPECT_EQ(problem.n_bootstrap_samples, 11);
    EXPECT_EQ(problem.model_error, 0.02);
    EXPECT_EQ(problem.next_parameter, "magnetization_A_m");
    EXPECT_EQ(*problem.highest_frequency_Hz, 2.);
  }

  TEST(CalibrationProblem, FitsInLogarithmsUnlessSaidOtherwise)
  {
    const CalibrationProblem problem = parse(ratio);
    EXPECT_TRUE(problem.free[0].logarithmic);
    EXPECT_FALSE(problem.model_error);
    EXPECT_EQ(problem.n_starts, 32);
  }

  TEST(CalibrationProblem, RefusesWithLineAndRemedy)
  {
    expect_refusal("", "nothing is free");
    expect_refusal(
        "[parameters.young_modulus_kPa]\nbounds = [1, 2]",
        "fit.toml:1: [parameters] young_modulus_kPa is not a known table; it is young_modulus_Pa in another unit: "
        "write young_modulus_Pa and multiply by 1000.");
    expect_refusal(
        ratio + "[fit]\nmethod = \"newton\"",
        "fit.toml:4: [fit] method = \"newton\" is not known; the nearest is \"lbfgs\" (one of \"lbfgs\", \"mma\"");
    expect_refusal("[parameters.viscosity_Pa_s]\nbound = [1, 2]", "the nearest known name is bounds");
    expect_refusal("[parameters.viscosity_Pa_s]\n", "needs either bounds = [low, high]");
    expect_refusal("[parameters.viscosity_Pa_s]\nvalue = 1\nbounds = [1, 2]", "needs either bounds = [low, high]");
    expect_refusal("[parameters.viscosity_Pa_s]\nvalue = -1", "must be positive");
    expect_refusal("[parameters.viscosity_Pa_s]\nbounds = [2, 1]", "leave nothing between them");
    expect_refusal("[parameters.viscosity_Pa_s]\nbounds = [0, 1]", "only positive values are possible");
    expect_refusal("[parameters.viscosity_Pa_s]\nbounds = [1, 2]\nstart = 3", "fit.toml:3: [parameters.viscosity_Pa_s] "
                                                                              "start = 3 lies outside the bounds");
    expect_refusal("[parameters.viscosity_Pa_s]\nbounds = [1, 2]\nprior_mean = 1.5", "is half a prior");
    expect_refusal("[parameters.viscosity_Pa_s]\nvalue = 1\nprior_mean = 1.5", "what value = ... fixes");
    expect_refusal("[parameters.displacement_offset_m]\nbounds = [-1, 1]\nscale = \"log\"", "may be negative");
    expect_refusal("[parameters.noise_scale]\nbounds = [0.1, 10]", "nothing is free");
    expect_refusal("[parameters.noise_scale]\nvalue = 2\n" + ratio, "change sigma_m in the data");
    expect_refusal(ratio + "[parameters.young_modulus_Pa]\nbounds = [1e4, 1e5]",
                   "young_modulus_Pa follows from young_modulus_over_viscosity_1_s");
    expect_refusal(ratio + "[loss]\nkind = \"hubert\"", "the nearest is \"huber\"");
    expect_refusal(ratio + "[uncertainty]\nlevel = 1", "less than 1");
    expect_refusal(ratio + "[next]\nparameter = \"young\"", "is not a free parameter");
    expect_refusal(ratio + "[next]\nlowest_frequency_Hz = 2\nhighest_frequency_Hz = 1", "is not below");
    expect_refusal("data = [1, 2]\n" + ratio, "a list of files");
  }
} // namespace swimtwin
