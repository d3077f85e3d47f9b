#include <datasets/scene/inertia_terms.h>
#include <tests/places.h>
#include <tests/twin/run/imagined_stream.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    Scene scene_named(const std::string &name)
    {
      return read_scene(std::string(places::scenes) + "/" + name + ".toml");
    }

    LabConfig lab_of(const Scene &scene, const std::string &toml)
    {
      const TemporaryFolder folder;
      return read_lab_config(written(folder, "lab.toml", toml), scene);
    }

    template <typename Action>
    std::string refusal(const Action &action)
    {
      try
      {
        action();
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return {};
    }
  } // namespace

  TEST(LabConfig, ASceneHasItsFullOrderSwimmerAndAModelHasBoth)
  {
    const Scene scene = scene_named("reference-2d-casefile");
    EXPECT_EQ(lab_of(scene, "seed = 1\n").swimmer, LabSwimmer::full_order);
    const TemporaryFolder folder;
    const ReducedModel    model = open_model();
    EXPECT_EQ(read_lab_config(written(folder, "a.toml", "seed = 1\n"), model).swimmer, LabSwimmer::reduced);
    EXPECT_EQ(read_lab_config(written(folder, "b.toml", "plant = \"full-order\"\n"), model).swimmer,
              LabSwimmer::full_order);
  }

  // A whole number of steps per frame, none longer than was asked for.
  TEST(LabConfig, StepsOfAFullOrderSwimmerEndAtFrames)
  {
    const Scene scene = scene_named("reference-2d-casefile");
    EXPECT_EQ(lab_of(scene, "steps_per_second = 60\n").steps_per_frame, 2);
    EXPECT_EQ(lab_of(scene, "steps_per_second = 61\n").steps_per_frame, 3);
    EXPECT_EQ(lab_of(scene, "steps_per_second = 10\n").steps_per_frame, 1);
  }

  TEST(LabConfig, TheSceneHasTheLaboratorysSwimmerInIt)
  {
    const Scene     scene  = scene_named("reference-2d-casefile");
    const LabConfig config = lab_of(scene, "inertia = \"none\"\n[swimmer]\nyoung_modulus_Pa = 1.1e5\n"
                                           "viscosity_Pa_s = 1.2\nmagnetization_A_m = 9e4\n");
    const Scene     in_lab = scene_in_laboratory(scene, config);
    EXPECT_NEAR(in_lab.tail->young_modulus_Pa, 1.1e5, 1e-8);
    EXPECT_NEAR(in_lab.fluid->viscosity_Pa_s, 1.2, 1e-14);
    EXPECT_NEAR(in_lab.head.magnetization_A_m, 9e4, 1e-8);
    EXPECT_FALSE(inertia_terms(in_lab).any());
    EXPECT_TRUE(inertia_terms(scene_in_laboratory(scene, lab_of(scene, "inertia = \"full\"\n"))).any());
  }

  // As many steps per period of the coils as the scene has of its own field, and never fewer than a scene may have.
  TEST(LabConfig, StepsFollowTheCoils)
  {
    const Scene     scene = scene_named("reference-2d-casefile"); // 100 per period
    const LabConfig slow  = lab_of(scene, "[coils]\nfrequency_Hz = 0.3\n"),
                    fast  = lab_of(scene, "[coils]\nfrequency_Hz = 3\n");
    EXPECT_EQ(slow.steps_per_frame, 1);
    EXPECT_EQ(fast.steps_per_frame, 10);
    EXPECT_NE(refusal([&] {
                lab_of(scene, "steps_per_second = 20\n[coils]\nfrequency_Hz = 3\n");
              }).find("below 10 steps per period"),
              std::string::npos);
  }

  TEST(LabConfig, RefusesASwimmerThatTheTwinCannotFollow)
  {
    Scene scene                  = scene_named("reference-2d-casefile");
    scene.head.magnetization_A_m = 0.;
    EXPECT_NE(refusal([&] { lab_of(scene, "seed = 1\n"); }).find("without magnetization_A_m"), std::string::npos);
    scene                              = scene_named("reference-3d-paper");
    scene.gravity.acceleration_m_s2[2] = -9.81;
    EXPECT_NE(refusal([&] { lab_of(scene, "seed = 1\n"); }).find("leaves the plane"), std::string::npos);
  }

  TEST(LabConfig, AFullOrderSwimmerHasNoMiracles)
  {
    const Scene scene = scene_named("reference-2d-casefile");
    const auto  of    = [&](const std::string &toml) { return refusal([&] { lab_of(scene, toml); }); };
    EXPECT_NE(of("[change]\ntime_s = 1\nstiffness_factor = 0.5\n").find("is for a reduced swimmer"), std::string::npos);
    EXPECT_NE(of("[temperature]\nrate_K_s = 1\n").find("is for a reduced swimmer"), std::string::npos);
    EXPECT_NE(of("[swimmer]\nflow_x_m_s = 1e-5\n").find("flow_x_m_s"), std::string::npos);
    EXPECT_NE(of("plant = \"reduced\"\n").find("full-order"), std::string::npos);
    const TemporaryFolder folder;
    const auto            file = written(folder, "lab.toml", "steps_per_second = 30\n");
    EXPECT_NE(refusal([&] { read_lab_config(file, open_model()); }).find("is of a full-order swimmer"),
              std::string::npos);
    EXPECT_NE(refusal([&] { lab_of(scene_named("csm1"), "seed = 1\n"); }).find("no free head"), std::string::npos);
  }
} // namespace swimtwin
