#include <datasets/scene/mirror_plane.h>

#include <datasets/system/error.h>
#include <tests/datasets/example_scenes.h>
#include <tests/datasets/temporary_folder.h>

#include <gtest/gtest.h>

#include <fstream>

namespace swimtwin
{
  namespace
  {
    using Overrides = std::vector<std::string>;

    Scene swimmer(const Overrides &overrides)
    {
      return parse_scene(swimmer_toml, "scene.toml", overrides);
    }
    /// The swimmer without a field across the axis, and what is added to it.
    Scene aligned(Overrides overrides)
    {
      overrides.insert(overrides.begin(), "field.by_T=0.0");
      return swimmer(overrides);
    }
    Scene beam(const Overrides &overrides)
    {
      return parse_scene(beam_toml, "scene.toml", overrides);
    }

    void expect_no_plane(const Scene &scene, const std::string &why)
    {
      const MirrorPlane plane = find_mirror_plane(scene);
      EXPECT_FALSE(plane.exists());
      expect_in(plane.missing, why);
      EXPECT_FALSE(solves_half(scene));
    }
    void expect_doubt(const Scene &scene, const std::string &why)
    {
      const MirrorPlane plane = find_mirror_plane(scene);
      EXPECT_TRUE(plane.exists()) << plane.missing;
      expect_in(plane.doubt, why);
      EXPECT_FALSE(solves_half(scene));
    }
    void expect_half(const Scene &scene)
    {
      const MirrorPlane plane = find_mirror_plane(scene);
      EXPECT_EQ(plane.missing, "");
      EXPECT_EQ(plane.doubt, "");
      EXPECT_TRUE(solves_half(scene));
    }

    const std::string moving_pair = "domain.walls={left=\"traction-free\", right=\"traction-free\", "
                                    "bottom={condition=\"moving-wall\", speed_m_s=1e-3}, "
                                    "top={condition=\"moving-wall\", speed_m_s=";
  } // namespace

  TEST(MirrorPlane, WhateverActsAcrossTheAxisTakesItAway)
  {
    expect_no_plane(swimmer({}), "the field acts across the axis");
    expect_no_plane(aligned({"gravity.acceleration_m_s2=[0.0, -9.81]"}), "gravity acts across the axis");
    expect_no_plane(aligned({"head.angle_rad=0.1"}), "starts at an angle");
    expect_no_plane(aligned({"head.center_m=[0.0, 1e-3]"}), "not on the domain's axis");
    expect_no_plane(aligned({moving_pair + "2e-3}}"}), "bottom and top differ");
    expect_no_plane(aligned({"domain.walls.top=\"traction-free\""}), "bottom and top differ");
    expect_no_plane(aligned({"domain.walls={left={condition=\"moving-wall\", speed_m_s=1e-3}}"}), "left moves across");
    expect_no_plane(aligned({"domain={shape=\"disc\", radius_m=0.03, walls={outer={condition=\"moving-wall\", "
                             "speed_m_s=1e-3}}}"}),
                    "outer moves across");
  }

  TEST(MirrorPlane, AFieldThatNothingFeelsDoesNotCount)
  {
    expect_half(swimmer({"head.magnetization_A_m=0.0"}));
  }

  TEST(MirrorPlane, AFieldProgramIsLookedThrough)
  {
    const TemporaryFolder folder;
    const auto            with_program = [&](const char *by, const char *bx) {
      std::ofstream(folder.path / "field.csv")
          << "time_s,bx_T,by_T\n0,1e-3,0\n0.25,1e-3,0\n0.5," << bx << "," << by << "\n0.75,1e-3,0\n";
      std::string text = swimmer_toml;
      const auto  from = text.find("[field]"), to = text.find("[time]");
      text.replace(from, to - from, "[field]\nprogram = \"field.csv\"\nperiod_s = 1.0\n");
      return parse_scene(text, (folder.path / "scene.toml").string());
    };
    expect_half(with_program("0", "2e-3"));
    expect_no_plane(with_program("1e-3", "2e-3"), "the field acts across the axis");
    expect_doubt(with_program("0", "-2e-3"), "the head's magnetization points against the field");
  }

  TEST(MirrorPlane, InSpaceAFieldAlongZTakesItAway)
  {
    const Overrides in_space{"dimension=3", "head.shape=cylinder", "domain.size_m=[40e-3, 20e-3, 20e-3]"};
    const auto      with = [&](const Overrides &more) {
      Overrides all = in_space;
      all.insert(all.end(), more.begin(), more.end());
      return swimmer(all);
    };
    expect_half(with({}));
    expect_half(with({"field.bz_T=1e-3", "head.magnetization_A_m=0.0"})); // nothing feels it
    expect_no_plane(with({"field.bz_T=1e-3"}), "the field has a component along z");
    expect_no_plane(with({"gravity.acceleration_m_s2=[0, 0, -9.81]"}), "gravity has a component along z");
    EXPECT_TRUE(find_mirror_plane(with({"gravity.acceleration_m_s2=[0, -9.81]"})).exists());
  }

  TEST(MirrorPlane, OfADomainIsOnItsAxisBetweenWallsThatAreAlike)
  {
    EXPECT_TRUE(domain_is_mirrored(swimmer({}))); // whatever the field does
    EXPECT_TRUE(domain_is_mirrored(swimmer({"head.angle_rad=0.1"})));
    EXPECT_TRUE(domain_is_mirrored(beam({})));
    EXPECT_FALSE(domain_is_mirrored(swimmer({"domain.center_m=[0, 1e-3]"})));
    EXPECT_TRUE(domain_is_mirrored(swimmer({"domain.center_m=[0, 1e-3]", "head.center_m=[0, 1e-3]"})));
    EXPECT_FALSE(domain_is_mirrored(swimmer({"domain.walls.top='traction-free'"})));
  }

  TEST(MirrorPlane, AnAlignedFieldHoldsTheSwimmer)
  {
    expect_half(aligned({}));
    expect_half(aligned({"tail.magnetization_A_m=1e4"}));
    expect_half(beam({}));
  }

  // What the whole scene would leave, or might, is not decided for the user.
  TEST(MirrorPlane, AnUnstableSymmetricMotionIsLeftToTheWholeScene)
  {
    expect_doubt(aligned({"field.bx_T=-5e-3"}), "the head's magnetization points against the field");
    expect_doubt(aligned({"head.magnetization_A_m=-1e5"}), "the head's magnetization points against the field");
    expect_doubt(aligned({"tail.magnetization_A_m=-1e4"}), "the tail's magnetization points against the field");
    expect_doubt(aligned({"gravity.acceleration_m_s2=[9.81, 0.0]"}), "a free body in a flow or falling");
    expect_doubt(aligned({moving_pair + "1e-3}}"}), "a free body in a flow or falling");
    expect_doubt(beam({"gravity.acceleration_m_s2=[-9.81, 0.0]"}), "the tail's weight compresses it");
    expect_half(beam({"gravity.acceleration_m_s2=[9.81, 0.0]"}));
    const std::string inflow = "domain.walls={left={condition=\"inflow\", speed_m_s=";
    expect_half(aligned({"head.motion=fixed", inflow + "1e-3}, right=\"traction-free\"}"}));
    expect_doubt(aligned({"head.motion=fixed", inflow + "-1e-3}, right=\"traction-free\"}"}), "the flow may compress");
    expect_doubt(aligned({"head.motion=fixed", moving_pair + "1e-3}}"}), "the flow may compress");
  }

  TEST(MirrorPlane, TheSceneHasTheLastWord)
  {
    EXPECT_FALSE(solves_half(aligned({"numerics.symmetric_half=off"})));
    const Scene insisting = aligned({"numerics.symmetric_half=on", "field.bx_T=-5e-3"});
    EXPECT_TRUE(solves_half(insisting));
    expect_in(symmetry_warning(insisting), "the head's magnetization points against the field");
    EXPECT_EQ(symmetry_warning(aligned({})), "");
    EXPECT_EQ(symmetry_warning(aligned({"field.bx_T=-5e-3"})), "");
    EXPECT_FALSE(solves_half(aligned({"numerics.coupling=fixed-point"})));
  }
} // namespace swimtwin
