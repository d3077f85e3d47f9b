#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/scene.h>
#include <tests/pipeline/simulation.h>
#include <tests/places.h>

namespace swimtwin
{
  namespace
  {
    std::vector<std::string> shipped_scenes()
    {
      std::vector<std::string> names;
      for (const auto &entry : std::filesystem::directory_iterator(places::scenes))
        if (entry.path().extension() == ".toml")
          names.push_back(entry.path().stem());
      std::sort(names.begin(), names.end());
      return names;
    }

    std::filesystem::path file_of(const std::string &name)
    {
      return std::filesystem::path(places::scenes) / (name + ".toml");
    }

    bool has_quick_variant(const std::string &name)
    {
      return content(file_of(name)).find("[variants.quick]") != std::string::npos;
    }

    std::vector<std::string> quick_scenes()
    {
      std::vector<std::string> names = shipped_scenes();
      std::erase_if(names, [](const std::string &name) { return !has_quick_variant(name); });
      return names;
    }

    /// Their own size takes minutes: of these only the quick variant is run.
    bool is_large(const std::string &name)
    {
      return has_quick_variant(name) && content(file_of(name)).find("\ndimension = 3") != std::string::npos;
    }

    std::vector<std::string> scenes_to_shrink()
    {
      std::vector<std::string> names = shipped_scenes();
      std::erase_if(names, is_large);
      return names;
    }

    /// A few steps on coarse meshes: of a periodic field or motion 2 of its first 20 steps, without one all that there
    /// are, and with inertia the first five.
    ShrunkScene shrunk(const std::string &name)
    {
      const ShrunkScene whole{name, {"numerics.mesh_growth=0.6"}};
      const Scene       scene = read_scene(file_of(name));
      if (scene.field.period_s() > 0. || scene.head.is_driven() || (scene.tail && scene.tail->is_driven()))
        return whole.with({"time.periods=0.1", "time.steps_per_period=20"});
      if (scene.time.is_steady)
        return whole;
      if (inertia_terms(scene).any())
        return whole.with({"time.steps=5", "time.duration_s=" + std::to_string(5. * scene.time.time_step_s())});
      return whole.with({"time.steps=" + std::to_string(std::min(scene.time.steps_per_period, 5)),
                         "time.duration_s=" + std::to_string(scene.time.period_s)});
    }

    std::string test_name(const testing::TestParamInfo<std::string> &test)
    {
      std::string name = test.param;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    }

    void expect_run(const std::string &name, const ShrunkScene &scene)
    {
      const TemporaryFolder folder;
      ASSERT_EQ(simulate(scene, folder.path).exit_code, 0);
      const Motion motion = read_motion(folder.path);
      EXPECT_EQ(motion.summary.status, "completed");
      EXPECT_GE(motion.trajectory.size(), 2);
      const bool has_tail = read_scene(file_of(name)).tail.has_value();
      EXPECT_EQ(std::filesystem::exists(folder.path / "snapshots.h5"), has_tail);
    }

    class ShippedScene : public testing::TestWithParam<std::string>
    {
    };

    class ShrunkShippedScene : public testing::TestWithParam<std::string>
    {
    };

    class QuickScene : public testing::TestWithParam<std::string>
    {
    };
  } // namespace

  TEST_P(ShippedScene, CanBePlannedByItsName)
  {
    std::vector<std::string> words{"plan", GetParam()};
    if (is_large(GetParam()))
      words.insert(words.end(), {"--set", "variant=quick"});
    const Outcome outcome = run_tool(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_in(outcome.out, GetParam());
  }

  TEST_P(ShrunkShippedScene, Runs)
  {
    expect_run(GetParam(), shrunk(GetParam()));
  }

  TEST_P(QuickScene, Runs)
  {
    expect_run(GetParam(), {GetParam(), {"variant=quick"}});
  }

  INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped_scenes()), test_name);
  INSTANTIATE_TEST_SUITE_P(All, ShrunkShippedScene, testing::ValuesIn(scenes_to_shrink()), test_name);
  INSTANTIATE_TEST_SUITE_P(All, QuickScene, testing::ValuesIn(quick_scenes()), test_name);
} // namespace swimtwin
