#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <datasets/run/plane_flow.h>

#include <iostream>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    /// Half a period of 10 steps, with fields at every other one.
    const ShrunkScene half_a_period = coarse_swimmer(20, 0.5).with({"output.fields_per_period=10"});

    /// What check_fields.py prints: the times of the tail's fields.
    std::string checked_times(const std::filesystem::path &fields)
    {
      const double  end_time_s = 0.5 / 0.9;
      const Outcome outcome    = run({places::python, "-B", std::string(places::checks) + "/check_fields.py", fields,
                                      std::to_string(end_time_s * 1e9) + "e-9"});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return outcome.out;
    }
  } // namespace

  TEST(Fields, AreQuadraticFiniteAndLeadToTheEnd)
  {
    const TemporaryFolder folder;
    simulate(half_a_period, folder.path);
    const auto times = checked_times(folder.path / "fields");
    EXPECT_EQ(std::count(times.begin(), times.end(), ' '), 5) << times; // six instants: 0, 2, ..., 10 steps
  }

  TEST(Fields, AreThereAfterARemeshToo)
  {
    const TemporaryFolder folder;
    simulate(half_a_period.with({"numerics.remesh_every_steps=1"}), folder.path);
    checked_times(folder.path / "fields");
  }

  // Two ways to one flow: the full-order model's motion, and Stokes problems around the reduced model's.
  TEST(Fields, OfAReducedRunHaveTheFullOrderModelsSpeeds)
  {
    const TemporaryFolder folder;
    const ShrunkScene same{"", {"tail.young_modulus_Pa=8e4", "head.magnetization_A_m=2e5", "field.frequency_Hz=0.9"}};
    std::vector<std::string> words{"reconstruct",
                                   "reference-2d",
                                   "--inertia",
                                   "none",
                                   "--flow",
                                   "--instants",
                                   "8",
                                   "--set",
                                   "time.periods=1",
                                   "--output",
                                   (folder.path / "reduced").string()};
    for (const auto &setting : same.settings)
      words.insert(words.end(), {"--set", setting});
    const Outcome outcome = run_tool(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    simulate(coarse_swimmer(40, 1.).with(same.settings), folder.path / "full");
    const auto full    = read_plane_flows(folder.path / "full/flow.h5"),
               reduced = read_plane_flows(folder.path / "reduced/flow.h5");
    ASSERT_EQ(full.size(), 4u);
    ASSERT_EQ(reduced.size(), 4u);
    const auto top_speed = [](const PlaneFlow &flow) { return flow.velocity_m_s.rowwise().norm().maxCoeff(); };
    for (std::size_t k = 0; k < 4; ++k)
    {
      EXPECT_NEAR(reduced[k].time_s, full[k].time_s, 1e-9);
      EXPECT_NEAR(top_speed(reduced[k]), top_speed(full[k]), .03 * top_speed(full[k]));
      std::cout << top_speed(reduced[k]) / top_speed(full[k]) - 1. << std::endl;
      for (const auto part : {SampledPart::fluid, SampledPart::head, SampledPart::tail})
      {
        const auto n_of = [&](const PlaneFlow &flow) { return (flow.part.array() == static_cast<int>(part)).count(); };
        EXPECT_NEAR(n_of(reduced[k]), n_of(full[k]), .1 * n_of(full[k]));
      }
    }
  }

  TEST(Fields, OfAResumedRunAreThoseOfAnUninterruptedOne)
  {
    const TemporaryFolder folder;
    simulate(half_a_period, folder.path / "whole");
    {
      ChildProcess interrupted(tool(simulate_arguments(half_a_period, folder.path / "resumed")));
      ASSERT_TRUE(interrupted.wait_for_file(folder.path / "resumed/fields/tail-0003.vtu"));
      ASSERT_TRUE(interrupted.kill());
    }
    simulate(half_a_period, folder.path / "resumed", {"--resume"});
    EXPECT_EQ(checked_times(folder.path / "resumed/fields"), checked_times(folder.path / "whole/fields"));
    const auto whole = read_plane_flows(folder.path / "whole/flow.h5"); // after 2, 5, 7 and 10 steps
    const auto again = read_plane_flows(folder.path / "resumed/flow.h5");
    ASSERT_EQ(whole.size(), 4u);
    ASSERT_EQ(again.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
    {
      EXPECT_EQ(again[k].time_s, whole[k].time_s);
      EXPECT_LE((again[k].velocity_m_s - whole[k].velocity_m_s).norm(), 1e-6 * whole[k].velocity_m_s.norm());
    }
  }

  TEST(Fields, OfAnEarlierRunAreReplacedOnlyWithForceAndThenAsAWhole)
  {
    const TemporaryFolder folder;
    simulate(half_a_period.with({"output.fields_per_period=20"}), folder.path);
    simulate(half_a_period, folder.path, {"--force"});
    checked_times(folder.path / "fields");
  }

  TEST(Fields, InSpaceAreQuadraticRestAtWallsAndMoveWithTheHead)
  {
    const TemporaryFolder folder;
    simulate(coarse_swimmer_in_space(0.25).with({"output.fields_per_period=8"}), folder.path);
    const double  head_back_x_m = 0.25e-3;
    const Outcome outcome       = run({places::python, "-B", std::string(places::checks) + "/check_fields_in_space.py",
                                       folder.path, std::to_string(head_back_x_m * 1e9) + "e-9"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "3 3 2\n"); // 0, 5, 10 steps; no fluid at the start
  }

  // Samples are 1/64 of a body length apart. Where the flow changes over four of these distances, straight lines
  // between them are (1/4)^2 / 8 off in each of two directions, 1.6 % together.
  TEST(Fields, AreThoseThatTheFlowInThePlaneIsSampledFrom)
  {
    for (const ShrunkScene &scene : {coarse_swimmer(20, 1.), coarse_swimmer_in_space(0.25)})
    {
      const TemporaryFolder folder;
      simulate(scene.with({"output.fields_per_period=40"}), folder.path);
      const Outcome outcome = run({places::python, "-B", std::string(places::checks) + "/check_flow.py", folder.path});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      std::istringstream words(outcome.out);
      int                n_compared = 0;
      double             difference = 1.;
      words >> n_compared >> difference;
      std::cout << "flow in the plane against fields: " << difference << " of the largest speed" << std::endl;
      EXPECT_EQ(n_compared, 4);
      EXPECT_LE(difference, 0.016);
    }
  }
} // namespace swimtwin
