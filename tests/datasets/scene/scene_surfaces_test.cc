#include <datasets/scene/scene.h>

#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/surface/closed_surface.h>
#include <datasets/system/error.h>
#include <tests/datasets/example_surfaces.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    const std::string body_toml = R"(dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
[domain]
shape = "box"
size_m = [0.01, 0.01, 0.01]
[head]
shape = "surface"
surface = "body.stl"
surface_unit_m = 1e-3
density_kg_m3 = 2000.0
magnetization_A_m = 1e5
[time]
duration_s = 1.0
steps = 2
)";

    const std::string walls_toml = R"(dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
[domain]
shape = "surface"
surface = "walls.msh"
surface_unit_m = 1e-3
[head]
shape = "sphere"
diameter_m = 2e-3
density_kg_m3 = 2000.0
[time]
duration_s = 1.0
steps = 2
)";

    const std::string tail_toml = "[tail]\nlaw = \"rigid\"\ndensity_kg_m3 = 1000.0\n";

    class SceneSurfaces : public testing::Test
    {
    protected:
      SceneSurfaces()
      {
        folder_.write("body.stl", stl_text(box_.moved({7., 8., 9.})));
        folder_.write("walls.msh", msh41_text(example_box({10., 10., 10.}, 3), 90));
      }

      Scene parse(const std::string &text, const std::vector<std::string> &overrides = {}) const
      {
        return parse_scene(text, (folder_.path / "scene.toml").string(), overrides);
      }
      void expect_refused(const std::string &text, const std::vector<std::string> &overrides,
                          const std::string &part) const
      {
        expect_in(message_of<InputError>([&] { parse(text, overrides); }), part);
      }

      ExampleSurface  box_ = example_box({2., 3., 1.}, 2);
      TemporaryFolder folder_;
    };
  } // namespace

  TEST_F(SceneSurfaces, BodyStandsWithItsCentreAtTheHeadsCentre)
  {
    const Scene scene = parse(body_toml);
    EXPECT_NEAR(scene.head.volume(3), 6e-9, 1e-20);
    EXPECT_NEAR(scene.head.size_m[0], 2e-3, 1e-15);
    EXPECT_NEAR(scene.head.size_m[1], 3e-3, 1e-15);
    EXPECT_NEAR(scene.body_length_m(), 3e-3, 1e-15);
    EXPECT_NEAR(scene.head.second_moment(3), 6e-9 * (4e-6 + 9e-6) / 12., 1e-24);
    const Extent box = extent(scene.head.surface->nodes);
    EXPECT_NEAR((box.low + box.high).norm(), 0., 1e-15);
    EXPECT_FALSE(solves_half(scene));
  }

  TEST_F(SceneSurfaces, WallsHaveTheNamesOfTheirFile)
  {
    const Scene scene = parse(walls_toml, {"domain.walls.open=traction-free"});
    EXPECT_EQ(scene.domain->walls.size(), 2u);
    EXPECT_EQ(scene.domain->walls.at("open").condition, WallCondition::traction_free);
    EXPECT_EQ(scene.domain->walls.at("sides").condition, WallCondition::no_slip);
    EXPECT_FALSE(solves_half(scene));
    expect_refused(walls_toml, {"domain.walls.outer=no-slip"}, "outer");
    expect_refused(walls_toml, {"domain.walls.open={condition=\"moving-wall\", speed_m_s=1.0}"},
                   "cannot be a moving wall where walls are read from a surface");
    expect_refused(walls_toml, {"domain.walls.open={condition=\"inflow\", speed_m_s=1.0}"},
                   "inflows need a straight wall of a box or a channel");
  }

  TEST_F(SceneSurfaces, ContentIsPartOfTheScene)
  {
    const Scene before = parse(body_toml);
    EXPECT_EQ(parse(body_toml).hash, before.hash);
    EXPECT_EQ(parse(before.text).hash, before.hash);
    folder_.write("body.stl", stl_text(box_));
    EXPECT_NE(parse(body_toml).hash, before.hash);
    expect_refused(before.text, {}, "[head] surface = \"body.stl\" has changed since this scene was written");
  }

  // A box of 4 x 1 x 2 mm whose last millimetre is elastic.
  TEST_F(SceneSurfaces, TailIsThePartOfTheSurfaceThatIsNamedSo)
  {
    ExampleSurface    box   = example_box({4., 1., 2.}, 4).moved({7., 8., 9.});
    const std::size_t first = sort_tail_last(box, [](const std::array<double, 3> &x) { return x[0] > 8.; });
    folder_.write("body.msh", msh41_text(box, first, {"head", "tail"}));
    const Scene scene = parse(body_toml + tail_toml, {"head.surface=body.msh"});
    ASSERT_TRUE(scene.tail && scene.tail->part);
    EXPECT_NEAR(scene.head.volume(3), 6e-9, 1e-20);
    EXPECT_NEAR(scene.head.size_m[0], 3e-3, 1e-15);
    EXPECT_NEAR(scene.tail->length_m, 1e-3, 1e-15);
    EXPECT_NEAR(scene.tail->root_height_m, 2e-3, 1e-15);
    EXPECT_NEAR(scene.body_length_m(), 4e-3, 1e-15);
    const Extent whole = extent(scene.head.surface->nodes);
    EXPECT_NEAR(whole.low[0], -1.5e-3, 1e-15); // the head's own centre is the origin
    EXPECT_NEAR(whole.high[0], 2.5e-3, 1e-15);
    EXPECT_EQ(parse(scene.text).hash, scene.hash);
  }

  // Of two equal bodies side by side the ends of both, or of one, are elastic.
  TEST_F(SceneSurfaces, ATailOnOneSideMovesInSpace)
  {
    ExampleSurface both = example_box({2., 1., 1.}, 2).moved({0., 0., 1.});
    both.add(example_box({2., 1., 1.}, 2).moved({0., 0., -1.}));
    const std::size_t first =
        sort_tail_last(both, [](const std::array<double, 3> &x) { return x[0] > 0. && x[2] > 0.; });
    folder_.write("body.msh", msh41_text(both, first, {"head", "tail"}));
    const Scene scene = parse(body_toml + tail_toml, {"head.surface=body.msh"});
    EXPECT_FALSE(moves_in_plane(scene));
    expect_in(way_out_of_plane(scene), "mirror image at z = 0");
  }

  TEST_F(SceneSurfaces, FilesInAnotherUnitAreTakenForAMistake)
  {
    expect_refused(walls_toml, {"domain.surface_unit_m=1.0"},
                   "[domain] surface_unit_m = 1 m makes the domain 10 m long, but the swimmer 0.002 m; if the file is "
                   "in mm, as it seems, set it to 1e-3");
    expect_refused(walls_toml, {"domain.surface_unit_m=1e-6"}, "if the file is in mm, as it seems, set it to 1e-3");
    expect_refused(body_toml, {"head.surface_unit_m=1.0"},
                   "[head] surface_unit_m = 1 m makes the domain 0.01 m long, but the swimmer 3 m; if the file is in "
                   "mm, as it seems, set it to 1e-3");
    expect_refused(body_toml, {"head.surface_unit_m=1e-6"}, "if the file is in mm, as it seems, set it to 1e-3");
    expect_refused(walls_toml, {"head.diameter_m=20e-3"}, "does not contain the swimmer"); // no unit mends that
    EXPECT_NO_THROW(parse(body_toml, {"domain.size_m=[1.2, 1.2, 1.2]"}));                  // 400 times, nor that
  }

  TEST_F(SceneSurfaces, SliversAreWarnedOfByTheFileTheyAreIn)
  {
    EXPECT_TRUE(sliver_warnings(parse(body_toml)).empty());
    EXPECT_TRUE(sliver_warnings(parse(walls_toml)).empty());
    folder_.write("body.stl", stl_text(example_box({2., 2., 0.02})));
    const auto of_body = sliver_warnings(parse(body_toml));
    ASSERT_EQ(of_body.size(), 1u);
    expect_in(of_body[0],
              "body.stl has a triangle of quality 0.017"); // sqrt(12) a b / (a^2 + b^2 + c^2), of 2 and 0.02
    folder_.write("walls.msh", msh41_text(example_box({500., 10., 10.}), 6));
    const auto of_walls = sliver_warnings(parse(walls_toml));
    ASSERT_EQ(of_walls.size(), 1u);
    expect_in(of_walls[0], "walls.msh has a triangle of quality 0.035");
  }

  TEST_F(SceneSurfaces, EntriesGoWithTheShape)
  {
    expect_refused(body_toml, {"head.shape=sphere", "head.diameter_m=1e-3"}, "surface = \"body.stl\" does not belong");
    expect_refused(body_toml, {"head.size_m=[1e-3, 1e-3]"}, "does not belong to the shape surface, which has its size");
    expect_refused(body_toml, {"numerics.mesh_size_m=1e-4"}, "whose triangles are the mesh there");
    expect_refused(body_toml + tail_toml, {"tail.length_m=1e-3"},
                   "does not belong to a tail that is part of the head's");
    expect_refused(body_toml + tail_toml, {"tail.law=prescribed", "tail.wave={angle_rad=0.1, frequency_Hz=1.0}"},
                   "cannot be \"prescribed\" of a tail that is part of the head's surface");
    expect_refused(body_toml + tail_toml, {}, "body.stl: it has no physical surface named \"tail\"");
    expect_refused(walls_toml, {"domain.radius_m=1.0"}, "radius_m = 1 does not belong to the shape surface");
    expect_refused(walls_toml, {"numerics.symmetric_half=on"}, "the walls are read from a surface");
    std::string text = body_toml;
    text.erase(text.find("surface_unit_m = 1e-3\n"), 22);
    expect_refused(text, {}, "surface_unit_m is missing; the shape surface needs it");
    expect_refused(body_toml, {"dimension=2", "domain.size_m=[1.0, 1.0]"}, "[head] shape = \"surface\" is not known");
    expect_refused(body_toml, {"head.surface=bodi.stl"}, "cannot read the surface");
  }

  TEST_F(SceneSurfaces, BodyIsWithinWalls)
  {
    expect_refused(body_toml, {"head.center_m=[4.5e-3, 0.0]"}, "reaches 0.0005 m beyond the right wall");
    expect_refused(walls_toml, {"head.center_m=[4.5e-3, 0.0]"}, "reaches 0.0005 m beyond the ");
    expect_refused(walls_toml, {"head.center_m=[9e-3, 0.0]"}, "beyond the ");
    const std::vector<std::string> both{"head={shape=\"surface\", surface=\"body.stl\", surface_unit_m=1e-3, "
                                        "motion=\"fixed\"}"};
    EXPECT_NO_THROW(parse(walls_toml, both));
    const std::vector<std::string> through{"head={shape=\"surface\", surface=\"body.stl\", surface_unit_m=1e-2, "
                                           "motion=\"fixed\"}"};
    expect_refused(walls_toml, through, "does not contain the swimmer, which reaches");
  }

  TEST_F(SceneSurfaces, WallsStandAnywhereInSpace)
  {
    const Scene  scene = parse(walls_toml, {"domain.center_m=[1e-3, 2e-3, 3e-3]"});
    const Extent box   = extent(scene.domain->surface->nodes);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(box.low[c], (c - 4.) * 1e-3, 1e-15);
      EXPECT_NEAR(box.high[c], (c + 6.) * 1e-3, 1e-15);
    }
    expect_in(way_out_of_plane(scene), "the walls' surface is up to 0.006 m away from its mirror image at z = 0");
    expect_refused(walls_toml, {"domain.center_m=[0.0, 0.0, 4.5e-3]"}, "does not contain the swimmer, which reaches");
    expect_refused(walls_toml, {"head.center_m=[0.0, 0.0, 1e-3]"},
                   "[head] center_m = [0, 0, 0.001] is off the plane z = 0, in which heads start; leave out");
    EXPECT_EQ(parse(body_toml, {"domain.center_m=[1e-3, 0.0, 0.0]"}).domain->center_m[0], 1e-3);
    expect_refused(body_toml, {"domain.center_m=[0.0, 0.0, 1e-3]"},
                   "[domain] center_m = [0, 0, 0.001] is off the plane z = 0, in which walls that are known by");
  }

  TEST_F(SceneSurfaces, BodyThatIsNoMirrorImageMovesInSpace)
  {
    ExampleSurface wedge = box_;
    for (auto &x : wedge.points)
      x[1] += .5 * x[2];
    EXPECT_TRUE(moves_in_plane(parse(body_toml, {})));
    folder_.write("body.stl", stl_text(wedge));
    const Scene scene = parse(body_toml, {});
    EXPECT_FALSE(moves_in_plane(scene));
    EXPECT_EQ(way_out_of_plane(scene), "the head's surface is up to 0.000447 m away from its mirror image at z = 0");
  }
} // namespace swimtwin
