#include <fom/coupling/coupling.h>

#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    std::string remedy_in(const std::string &scene, const std::vector<std::string> &settings = {})
    {
      return remedy(StepOutcome::coupling_diverged, shipped_scene(scene, settings));
    }

    bool says(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }
  } // namespace

  TEST(Remedy, NamesWhatDrivesTheScene)
  {
    const std::string field = remedy_in("reference-2d-casefile"), fall = remedy_in("csm1"), stream = remedy_in("cfd1");
    expect_in(field, "(the field, magnetization_A_m, young_modulus_Pa)");
    expect_in(fall, "([gravity], young_modulus_Pa)");
    expect_in(stream, "(the imposed speeds");
    for (const auto &other : {fall, stream})
      EXPECT_FALSE(says(other, "magnetization"));
  }

  TEST(Remedy, AsksASteadySceneForNoSteps)
  {
    expect_in(remedy_in("reference-2d-casefile"), "raise [time] steps_per_period");
    EXPECT_FALSE(says(remedy_in("cfd1"), "steps"));
    expect_in(remedy_in("cfd1"), "leave out [time] steady");
  }
} // namespace swimtwin
