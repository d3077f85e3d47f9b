#include <control/goal/goal_file.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  TEST(CalibratedMembers, AreTakenEvenlyFromTheSample)
  {
    const TemporaryFolder folder;
    CalibrationResult     result;
    result.status = "converged";
    for (int i = 0; i < 10; ++i)
      result.posterior.push_back(
          {.young_modulus_Pa = 1e5 + i, .viscosity_Pa_s = 1.5, .magnetization_A_m = 1e5, .field_scale = 1.1});
    SwimmingGoal goal;
    EXPECT_TRUE(members_of(goal).empty());
    goal.robust.calibration = folder.path / "calibration.json";
    goal.robust.n_members   = 3;
    write_calibration_result(goal.robust.calibration, result);
    const auto members = members_of(goal);
    ASSERT_EQ(members.size(), 3u);
    EXPECT_EQ(members[1].young_modulus_Pa, 1e5 + 3);
    EXPECT_NEAR(members[1].magnetization_A_m, 1.1e5, 1e-6);
    result.posterior.clear();
    write_calibration_result(goal.robust.calibration, result);
    EXPECT_NE(message_of<InputError>([&] { members_of(goal); }).find("has no sample of swimmers"), std::string::npos);
  }
} // namespace swimtwin
