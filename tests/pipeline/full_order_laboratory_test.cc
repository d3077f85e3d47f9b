#include <tests/pipeline/child_process.h>
#include <tests/places.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::filesystem::path write(const TemporaryFolder &folder, const char *name, const std::string &text)
    {
      std::ofstream(folder.path / name) << text;
      return folder.path / name;
    }

    constexpr const char *coils = "bx_T = 5e-3\nby_T = 5e-3\nfrequency_Hz = 1\n";
  } // namespace

  // The full-order swimmer of the case files, 10 % stiffer and 8 % stronger than the twin begins with, inertia on both
  // sides: four periods tell both to 3 %.
  TEST(FullOrderLaboratory, ItsSwimmerIsKnownToTheTwin)
  {
    const TemporaryFolder folder;
    const auto            lab = write(
                              folder, "lab.toml",
                              std::string("duration_s = 4\nplant = \"full-order\"\ninertia = \"full\"\nsteps_per_second = 60\n"
                                                     "[swimmer]\nyoung_modulus_Pa = 8.8e4\nmagnetization_A_m = 2.15e5\n[coils]\n") +
                                  coils),
               twin        = write(folder, "twin.toml", std::string("inertia = \"full\"\n[field]\n") + coils);
    const Outcome imagined = run_tool({"lab", "reference-2d", lab, "--output", folder.path / "lab"});
    ASSERT_EQ(imagined.exit_code, 0) << imagined.err;
    const auto    recording = write(folder, "lab.jsonl", imagined.out);
    std::ifstream truth(folder.path / "lab/truth.csv");
    std::string   header;
    std::getline(truth, header);
    EXPECT_EQ(header, "time_s,x_m,y_m,angle_rad,tip_x_m,tip_y_m");
    const Outcome seen =
        run_tool({"twin", "reference-2d", twin, "--replay", recording, "--output", folder.path / "twin"});
    ASSERT_EQ(seen.exit_code, 0) << seen.err;
    nlohmann::json     last;
    std::istringstream lines(seen.out);
    for (std::string line; std::getline(lines, line);)
      if (const auto json = nlohmann::json::parse(line); json["type"] == "estimate")
        last = json;
    const auto value = [&](const char *name) { return last["parameters"][name]["value"].get<double>(); };
    EXPECT_NEAR(value("young_modulus_over_viscosity_1_s"), 8.8e4 / 1.52, 0.03 * 8.8e4 / 1.52);
    EXPECT_NEAR(value("magnetization_over_viscosity_A_m_Pa_s"), 2.15e5 / 1.52, 0.02 * 2.15e5 / 1.52);
  }

  TEST(FullOrderLaboratory, ASceneIsEnough)
  {
    const TemporaryFolder folder;
    const auto            lab =
        write(folder, "lab.toml",
              std::string(
                  "duration_s = 0.1\ninertia = \"none\"\nsteps_per_second = 30\n[camera]\nsees_tip = true\n[coils]\n") +
                  coils);
    const Outcome imagined = run_tool({"lab", "reference-2d-casefile", lab});
    ASSERT_EQ(imagined.exit_code, 0) << imagined.err;
    EXPECT_NE(imagined.out.find("\"points\":[{\"share\":1"), std::string::npos) << imagined.out;
    EXPECT_EQ(std::count(imagined.out.begin(), imagined.out.end(), '\n'), 4); // the drive and three frames
    expect_failure(run_tool({"lab", "csm1", lab}), 2, {"no free head"});
    expect_failure(run_tool({"lab", "reference-2d-casefile",
                             write(folder, "change.toml", "[change]\ntime_s = 1\nstiffness_factor = 0.5\n")}),
                   2, {"change", "is for a reduced swimmer"});
    expect_failure(run_tool({"lab", "no-such-thing", lab}), 2, {"no-such-thing"});
  }
} // namespace swimtwin
