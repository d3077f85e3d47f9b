// Plans of reduced swimmers on the full-order model.
#include <tests/pipeline/simulation.h>

#include <datasets/files/json_entries.h>
#include <datasets/text/csv_table.h>

#include <cmath>

namespace swimtwin
{
  // Turned about its head, the swimmer would begin 1.5 mm beside the channel's axis, where its resistance is another
  // one than the model knows: 1.2 to 1.8 % of the displacement of plans that are 0.1 % off on the axis.
  TEST(Replay, StartsWithTheBodysMiddleOnTheAxisOfAChannel)
  {
    const TemporaryFolder folder;
    const std::string     goal    = folder.write("goal.toml", brief_goal());
    const auto            results = folder.path / "plan";
    const Outcome         outcome =
        run_tool({"optimize", "reference-2d", goal, "--inertia", "none", "--replay", "--replay-periods", "2",
                  "--replay-steps", "50", "--no-picture", "--output", results.string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json fields = read_json_file(results / "plan.json", "the plan", "").at("replay").at("fields");
    ASSERT_EQ(fields.size(), 2u);
    const char *folders[] = {"tuned-sinusoid", "optimal-field"};
    for (std::size_t i = 0; i < 2; ++i)
    {
      const auto   rows  = CsvTable::read(results / "replay" / folders[i] / "trajectory.csv");
      const double angle = fields[i].at("start_angle_rad"), x = rows.column("head_x_m")[0],
                   y = rows.column("head_y_m")[0];
      ASSERT_GT(std::abs(angle), 0.1);
      // c = m - R(angle) (m, 0), with the middle m behind the head's centre (TurnedCenter).
      const double middle_m = -y / std::sin(angle);
      EXPECT_GT(middle_m, 1e-3);
      EXPECT_NEAR(x, middle_m * (1. - std::cos(angle)), 1e-9);
      const double full = fields[i].at("displacement_m")[1], reduced = fields[i].at("reduced_displacement_m")[1];
      EXPECT_NEAR(reduced, full, 0.006 * full); // on few steps; 1.0 % if it is turned about its head
    }
  }
} // namespace swimtwin
