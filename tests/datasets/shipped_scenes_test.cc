#include <datasets/scene/scene.h>
#include <datasets/scene/swimmer_clearance.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    const std::filesystem::path scenes = places::scenes;

    Scene shipped(const std::string &name)
    {
      return read_scene(scenes / (name + ".toml"));
    }

    double highest_x_m(const Scene &scene)
    {
      const auto outline = swimmer_outline(scene);
      return (*std::max_element(outline.begin(), outline.end()))[0];
    }
  } // namespace

  TEST(ShippedScenes, AllParse)
  {
    int n_scenes = 0;
    for (const auto &entry : std::filesystem::directory_iterator(scenes))
      if (entry.path().extension() == ".toml")
      {
        ++n_scenes;
        Scene scene;
        EXPECT_NO_THROW(scene = read_scene(entry.path())) << entry.path();
        EXPECT_EQ(scene.name, entry.path().stem());
        EXPECT_EQ(parse_scene(scene.text, (scenes / "again.toml").string()).text, scene.text);
      }
    EXPECT_GE(n_scenes, 10);
  }

  // Values of the paper and of the public case files (arXiv 2511.02402; feelpp/toolboxes/fsi/cases/magneto).
  TEST(ShippedScenes, ReferenceSwimmersHaveThePublishedValues)
  {
    const Scene paper = shipped("reference-2d-paper"), casefile = shipped("reference-2d-casefile");
    EXPECT_NEAR(highest_x_m(paper), 7.75e-3, 1e-15);
    EXPECT_DOUBLE_EQ(paper.head.magnetization_A_m, 1e5);
    EXPECT_DOUBLE_EQ(paper.tail->young_modulus_Pa, 1e5);
    EXPECT_DOUBLE_EQ(paper.time.period_s, 1. / 0.8);
    EXPECT_EQ(paper.time.n_steps(), 300);
    EXPECT_DOUBLE_EQ(casefile.head.magnetization_A_m, 2e5);
    EXPECT_DOUBLE_EQ(casefile.tail->young_modulus_Pa, 8e4);
    EXPECT_DOUBLE_EQ(casefile.tail->density_kg_m3, 1200.);
    EXPECT_EQ(casefile.domain->walls.at("left").condition, WallCondition::traction_free);
    EXPECT_EQ(casefile.domain->walls.at("top").condition, WallCondition::no_slip);
  }

  TEST(ShippedScenes, TheOpenSceneMovesWithItsSwimmer)
  {
    const Scene scene = shipped("open-2d");
    EXPECT_TRUE(scene.domain->moves_with_swimmer);
    EXPECT_DOUBLE_EQ(scene.domain->radius_m, 0.04);
  }

  // The benchmark's point A = (0.6, 0.2).
  TEST(ShippedScenes, TurekHronFlagEndsAtA)
  {
    for (const char *name : {"csm1", "csm2"})
    {
      EXPECT_NEAR(highest_x_m(shipped(name)), 0.6, 1e-15);
      EXPECT_FALSE(shipped(name).fluid.has_value());
    }
  }

  // Group 12 M B L^2 / (E' h^2) = 6.4 of the elastica solution quoted in the scene.
  TEST(ShippedScenes, CantileverHasTheGroupOfItsReference)
  {
    const Scene  scene       = shipped("magnetised-cantilever");
    const Tail  &tail        = *scene.tail;
    const auto   b           = scene.field(scene.time.period_s);
    const double plane       = tail.young_modulus_Pa / (1. - tail.poisson_ratio * tail.poisson_ratio);
    const double slenderness = tail.length_m / tail.root_height_m;
    EXPECT_NEAR(std::hypot(b[0], b[1]), 0.01, 1e-15);
    EXPECT_NEAR(std::atan2(b[1], b[0]), 2. * std::numbers::pi / 3., 1e-12);
    EXPECT_NEAR(12. * tail.magnetization_A_m * 0.01 * slenderness * slenderness / plane, 6.4, 1e-10);
    EXPECT_EQ(scene.head.magnetization_A_m, 0.);
  }
} // namespace swimtwin
