#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <regex>

namespace swimtwin
{
  namespace
  {
#ifdef __SANITIZE_ADDRESS__
    constexpr bool sanitized = true;
#else
    constexpr bool sanitized = false;
#endif

    const ShrunkScene run_of_5000_unknowns = coarse_swimmer(20, 0.1);

    Outcome simulate_within(const std::string &limit, const ShrunkScene &scene, const std::filesystem::path &folder)
    {
      std::string line = "ulimit " + limit + "; exec timeout 120 " + std::string(places::tool);
      for (const std::string &word : simulate_arguments(scene, folder, {"--quiet"}))
        line += " " + word;
      return run({"bash", "-c", line});
    }
  } // namespace

  // Whatever the limit, the run ends: with its results, or with one sentence.
  TEST(Memory, TooLittleIsOneSentence)
  {
    if (sanitized)
      GTEST_SKIP() << "a sanitizer takes all address space for itself";
    bool refused = false, done = false;
    for (const int limit_MB : {60, 300, 550, 650, 680, 700, 720, 740, 760, 780, 800, 900})
    {
      const TemporaryFolder folder;
      const Outcome         outcome =
          simulate_within("-v " + std::to_string(1000 * limit_MB), run_of_5000_unknowns, folder.path);
      done = done || outcome.exit_code == 0;
      if (outcome.exit_code == 0)
        continue;
      refused = true;
      SCOPED_TRACE(limit_MB);
      expect_failure(outcome, 1, {"memory"});
      EXPECT_EQ(outcome.err.find("defect"), std::string::npos) << outcome.err;
    }
    EXPECT_TRUE(refused);
    EXPECT_TRUE(done);
  }

  TEST(Memory, TheSentenceSaysWhatIsNeededAndWhatIsAllowed)
  {
    if (sanitized)
      GTEST_SKIP() << "a sanitizer takes all address space for itself";
    const TemporaryFolder folder;
    expect_failure(simulate_within("-v 300000", run_of_5000_unknowns, folder.path), 1,
                   {"too little memory", "libraries of the full-order model", "MB more", "ulimit -v leaves"});
    expect_failure(simulate_within("-d 100000", run_of_5000_unknowns, folder.path), 1, {"ulimit -d leaves"});
    expect_failure(
        simulate_within("-v 780000", run_of_5000_unknowns.with({"numerics.mesh_growth=0.1"}), folder.path / "fine"), 1,
        {"too little memory", "unknowns needs about", "ulimit -v leaves", "coarser mesh", "mesh_growth"});
  }

  // Factors fill in more in space: 15.5 kB per unknown, not 4.
  TEST(Memory, SystemsInSpaceNeedMore)
  {
    if (sanitized)
      GTEST_SKIP() << "a sanitizer takes all address space for itself";
    const TemporaryFolder folder;
    const Outcome outcome = simulate_within("-v 950000", {"reference-3d-paper", {"variant=quick"}}, folder.path);
    expect_failure(outcome, 1, {"too little memory", "unknowns needs about"});
    std::smatch      found;
    const std::regex numbers("a system of ([0-9]+) unknowns needs about ([0-9]+) MB");
    ASSERT_TRUE(std::regex_search(outcome.err, found, numbers)) << outcome.err;
    EXPECT_NEAR(std::stod(found[2]), 0.0155 * std::stod(found[1]), 2.);
  }
} // namespace swimtwin
