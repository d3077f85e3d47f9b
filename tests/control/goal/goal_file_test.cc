#include <control/goal/goal_file.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/rom/example_model.h>

#include <numbers>

namespace swimtwin
{
  namespace
  {
    class Goals : public ::testing::Test
    {
    protected:
      GoalFile read(const std::string &text) const { return read_goal(folder.write("goal.toml", text), model); }
      void     expect_refusal(const std::string &text, const std::string &part) const
      {
        const std::string message = message_of<InputError>([&] { read(text); });
        EXPECT_NE(message.find(part), std::string::npos) << message;
      }

      const TemporaryFolder folder;
      const ReducedModel    model = example_model({.depends_on_angle = false});
      const std::string     least = "[objective]\nmean_speed = 1\n[limits]\nmagnitude_T = 7e-3\n";
    };
  } // namespace

  TEST_F(Goals, TakeFromTheModelWhatTheyLeaveOut)
  {
    const GoalFile file = read(least);
    EXPECT_EQ(file.goal.weights.at(StrokeTerm::mean_speed), 1.);
    EXPECT_EQ(file.goal.swimmer.young_modulus_Pa, example_request(model).parameters.young_modulus_Pa);
    EXPECT_EQ(file.goal.frequency_Hz.high, model.range.frequency_Hz.high);
    EXPECT_EQ(file.goal.motion.largest_multiplier, 0.8);
    EXPECT_EQ(file.goal.motion.shape_radius, 1.);
    EXPECT_EQ(file.goal.field.magnitude_T, 7e-3);
    EXPECT_EQ(file.goal.field.turn_rad, 0.);
  }

  TEST_F(Goals, SayEverything)
  {
    const GoalFile file = read(R"([objective]
mean_speed = 1
magnetic_work = 0.1
direction_deg = 90
[swimmer]
young_modulus_Pa = 5e4
[field]
harmonics = 3
family = "symmetric"
frequency_high_Hz = 2
[limits]
bx_T = 4e-3
by_T = 5e-3
coil_1_A_T = [1000, 0]
coil_2_A_T = [0, 900.0]
coil_current_A = 3
slew_rate_T_s = 0.2
heading_deviation_deg = 45
[search]
method = "ccsaq"
seed = 7
starts = 0
)");
    EXPECT_EQ(file.goal.weights.at(StrokeTerm::magnetic_work), 0.1);
    EXPECT_NEAR(file.goal.field.turn_rad, -std::numbers::pi / 2., 1e-12);
    EXPECT_EQ(file.goal.swimmer.young_modulus_Pa, 5e4);
    EXPECT_EQ(file.goal.n_harmonics, 3);
    EXPECT_EQ(file.goal.family, FieldFamily::symmetric);
    EXPECT_EQ(file.goal.frequency_Hz.high, 2.);
    ASSERT_EQ(file.goal.field.current_per_field_A_T.rows(), 2);
    EXPECT_EQ(file.goal.field.current_per_field_A_T(1, 1), 900.);
    EXPECT_NEAR(file.goal.motion.heading_deviation_rad, std::numbers::pi / 4., 1e-12);
    EXPECT_EQ(file.options.search.search.method, SearchMethod::ccsaq);
    EXPECT_EQ(file.options.n_starts, 0);
    EXPECT_EQ(file.options.seed, 7u);
  }

  TEST_F(Goals, AreRefusedWithLineKeyAndRemedy)
  {
    expect_refusal(least + "magnitude_mT = 7\n", "goal.toml:5: [limits] magnitude_mT is not a known entry; it is "
                                                 "magnitude_T in another unit: write magnitude_T = 0.007.");
    expect_refusal("[objectiv]\nmean_speed = 1\n", "the nearest known name is objective");
    expect_refusal("[objective]\nspeed = 1\n[limits]\nmagnitude_T = 7e-3\n", "the nearest known name is mean_speed");
    expect_refusal("[limits]\nmagnitude_T = 7e-3\n", "mean_speed is missing");
    expect_refusal("[objective]\nmean_speed = 1\n", "nothing else bounds the field");
    expect_refusal("[objective]\nmean_speed = 1\n[limits]\nbx_T = 1e-3\n", "or bx_T and by_T");
    expect_refusal("[objective]\nmean_speed = 1\n[limits]\nmagnitude_T = -1\n", "must be positive (unit: T)");
    expect_refusal(least + "[field]\nfrequency_low_Hz = 30\n", "leaves no frequency: from 30 to 3 Hz");
    expect_refusal(least + "[field]\nfamily = \"sinus\"\n", "the nearest is \"sinusoid\"");
    for (const char *method : {"newton", "lbfgs"}) // the second takes no constraints
      expect_refusal(least + "[search]\nmethod = \"" + method + "\"\n",
                     std::string("goal.toml:6: [search] method = \"") + method + "\" is not known");
    expect_refusal(least + "[search]\ngradient_free_method = \"slsqp\"\n", "(one of \"cobyla\", \"isres\")");
    expect_refusal(least + "[robust]\nmembers = 3\n", "calibration is missing");
    expect_refusal("[objective\n", "goal.toml");
  }
} // namespace swimtwin
