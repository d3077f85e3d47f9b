#include <datasets/system/nearest_name.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  TEST(NearestName, HasTheSmallestEditDistance)
  {
    EXPECT_EQ(nearest_name("viscosty", {"density", "viscosity"}), "viscosity");
    EXPECT_EQ(nearest_name("any", {}), "");
  }

  TEST(CloseName, IsNamedWhateverItsCaseOrEnding)
  {
    EXPECT_EQ(close_name("scnee.toml", {"other.csv", "scene.toml"}), "scene.toml");
    EXPECT_EQ(close_name("Scene.TOML", {"scene.toml"}), "scene.toml");
    EXPECT_EQ(close_name("run.csv", {"run.txt"}), "run.txt");
  }

  TEST(CloseName, IsNoNameThatHasLittleInCommon)
  {
    EXPECT_FALSE(close_name("scene.toml", {"model.h5", "notes"}));
    EXPECT_FALSE(close_name("scene.toml", {}));
  }
} // namespace swimtwin
