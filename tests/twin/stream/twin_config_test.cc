#include <tests/twin/run/imagined_stream.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    std::string refusal(const std::string &toml)
    {
      const ReducedModel model = open_model();
      try
      {
        twin_config(model, toml);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }

    TEST(TwinConfig, EstimatesStiffnessAndMagnetizationIfNothingIsSaid)
    {
      const ReducedModel model  = open_model();
      const TwinConfig   config = twin_config(model, "# all as it is\n");
      EXPECT_TRUE(config.options.parameters[TwinParameter::stiffness].is_estimated());
      EXPECT_TRUE(config.options.parameters[TwinParameter::magnetization].is_estimated());
      EXPECT_FALSE(config.options.parameters[TwinParameter::camera_delay].is_estimated());
      EXPECT_FALSE(config.drive);
    }

    TEST(TwinConfig, ModelsErrorLeavesSomethingOfTheRatiosUnlessItIsToldNotTo)
    {
      const ReducedModel    model = open_model();
      const Eigen::Matrix2d bias  = twin_config(model, plain_twin).options.ratio_bias;
      EXPECT_GT(bias.diagonal().minCoeff(), 0.);
      EXPECT_LT(bias.diagonal().maxCoeff(), 0.1 * 0.1); // what was known at the start
      EXPECT_EQ(twin_config(model, std::string(plain_twin) + "[model_error]\ndisplacement = 0\n").options.ratio_bias,
                Eigen::Matrix2d::Zero());
    }

    TEST(TwinConfig, RefusesWhatCannotBeInOneSentence)
    {
      const std::pair<std::string, std::string> faults[] = {
          {"[field]\nbx_T = 1e-3\n", "by_T"},
          {"[field]\nbx_T = 1e-3\nby_T = 1e-3\nfrequency_Hz = 0\n", "be positive"},
          {"[feild]\nbx_T = 1e-3\n", "field"},
          {"[parameters.camera_delay]\nsd = 0.1\n", "camera_delay_s"},
          {"[parameters.camera_delay_s]\nsd = -0.1\n", "not be negative"},
          {"[parameters.camera_delay_s]\nvalue = 5\n", "0 to 2 s"},
          {"[parameters.young_modulus_over_viscosity_log]\nvalue = 9\n", "logarithm"},
          {"[camera.points]\ntip = 1.5\n", "share"},
          {"[model_error]\ndisplacement = -0.01\n", "not be negative"},
          {"[filter]\nknee = 4\ngate = 3\n", "below knee"},
          {"[output]\nsmoothing_lag_s = 100\n", "window_s"},
          {"[output]\nsave_every = 0\n", "at least 1"},
          {"[start]\nangle_sd_rad = 0\n", "positive"},
          {"prior = \"nowhere.json\"\n", "nowhere.json"},
          {"[camera\n", "twin.toml"}};
      for (const auto &[toml, words] : faults)
      {
        const std::string message = refusal(toml);
        EXPECT_NE(message.find(words), std::string::npos) << toml << " -> " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      }
    }
  } // namespace
} // namespace swimtwin
