#include <control/goal/goal_file.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  std::vector<SwimmerParameters> members_of(const SwimmingGoal &goal)
  {
    if (goal.robust.calibration.empty())
      return {};
    const CalibrationResult result = read_calibration_result(goal.robust.calibration);
    if (result.posterior.empty())
      throw InputError(fmt::format("{} has no sample of swimmers to plan for (status: {}); run calibrate again with a "
                                   "bootstrap.",
                                   goal.robust.calibration.string(), result.status));
    const std::size_t n = std::min(result.posterior.size(), static_cast<std::size_t>(goal.robust.n_members));
    std::vector<SwimmerParameters> members;
    for (std::size_t i = 0; i < n; ++i)
    {
      const CalibratedSwimmer &swimmer = result.posterior[i * result.posterior.size() / n];
      SwimmerParameters        member  = goal.swimmer;
      member.young_modulus_Pa          = swimmer.young_modulus_Pa;
      member.viscosity_Pa_s            = swimmer.viscosity_Pa_s;
      member.magnetization_A_m         = swimmer.magnetization_A_m * swimmer.field_scale;
      members.push_back(member);
    }
    return members;
  }
} // namespace swimtwin
