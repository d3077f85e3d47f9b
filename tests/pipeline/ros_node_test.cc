#include <tests/pipeline/child_process.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <fstream>

namespace swimtwin
{
  // No ROS here: its modules are imagined. The node, the twin and what goes between them are real.
  TEST(RosNode, CarriesPosesInAndEstimatesAndFieldsOut)
  {
    const TemporaryFolder folder;
    const std::string     bench = std::string(places::source) + "/bench/twin";
    std::ofstream(folder.path / "lab.toml")
        << "duration_s = 8\n[coils]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.9\n";
    const Outcome imagined = run_tool({"lab", "open-2d", folder.path / "lab.toml"});
    ASSERT_EQ(imagined.exit_code, 0) << imagined.err;
    std::ofstream(folder.path / "lab.jsonl") << imagined.out;
    std::vector<std::string> words = {places::python, "-B", std::string(places::checks) + "/check_ros_node.py",
                                      bench + "/ros_node.py", folder.path / "lab.jsonl"};
    for (const std::string &word :
         tool({"twin", "open-2d", bench + "/steered-twin.toml", "--output", folder.path / "twin"}))
      words.push_back(word);
    const Outcome checked = run(words);
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_EQ(checked.out, "True True\n");
  }
} // namespace swimtwin
