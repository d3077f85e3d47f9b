#include <tests/stress/hard_swimmers.h>

#include <tests/places.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::string turning_field(const double period_s)
    {
      constexpr int      n = 60;
      std::ostringstream csv;
      csv << "time_s,bx_T,by_T\n";
      for (int i = 0; i < n; ++i)
      {
        const double phase = 2. * std::numbers::pi * i / n;
        csv << period_s * i / n << "," << 7e-3 * std::cos(phase) << "," << 7e-3 * std::sin(phase) << "\n";
      }
      return csv.str();
    }
  } // namespace

  double balance_bound(const int steps_per_period)
  {
    const double ratio = 100. / steps_per_period;
    return std::clamp(0.005 * ratio * ratio, 0.001, 0.05);
  }

  ShrunkScene hard_swimmer(const std::vector<std::string> &settings, const int steps_per_period, const double periods)
  {
    return coarse_swimmer(steps_per_period, periods).with({"output.snapshots_per_period=0"}).with(settings);
  }

  Motion expect_convergence(const ShrunkScene &scene, const int steps_per_period)
  {
    const TemporaryFolder folder;
    const Outcome         outcome = simulate(scene, folder.path, {"--quiet"});
    EXPECT_EQ(outcome.err, "");
    if (outcome.exit_code != 0)
      return {};
    Motion motion = read_motion(folder.path);
    EXPECT_EQ(motion.summary.status, "completed");
    if (const auto &worst = motion.summary.worst_power_imbalance)
      EXPECT_LE(std::abs(*worst), balance_bound(steps_per_period));
    else // nothing to balance
      EXPECT_EQ(motion.summary.work_of_last_period.value().scale_J_m(), 0.);
    return motion;
  }

  ShrunkScene swimmer_in_turning_field(const TemporaryFolder &folder, const double period_s,
                                       const std::vector<std::string> &settings)
  {
    folder.write("turn.csv", turning_field(period_s));
    std::string text  = content(std::string(places::scenes) + "/reference-2d-casefile.toml");
    const auto  field = text.find("[field]"), next = text.find("[time]");
    text.replace(field, next - field, "[field]\nprogram = \"turn.csv\"\nperiod_s = " + std::to_string(period_s) + "\n");
    ShrunkScene scene = hard_swimmer(settings, 80);
    scene.name        = folder.write("turning.toml", text);
    return scene;
  }
} // namespace swimtwin
