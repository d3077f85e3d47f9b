#include <datasets/scene/scene.h>
#include <datasets/scene/scene_names.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <tests/datasets/example_scenes.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/replaced.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    std::string message_for(const std::string &text, const std::vector<std::string> &overrides = {})
    {
      return message_of<InputError>([&] { parse_scene(text, "scene.toml", overrides); });
    }

    std::string message_after(const std::string &part, const std::string &by)
    {
      return message_for(replaced(swimmer_toml, part, by));
    }

    const std::string program_csv = "time_s,bx_T,by_T\n0,1e-3,0\n0.5,1e-3,1e-3\n1.0,1e-3,0\n1.5,1e-3,-1e-3\n";
    const std::string sinusoid    = "bx_T = 5e-3\nby_T = 5e-3\nfrequency_Hz = 0.8\n";
  } // namespace

  TEST(SceneReader, ReadsEveryEntryOfASwimmer)
  {
    const Scene scene = parse_scene(swimmer_toml, "folder/scene.toml");
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.dimension, 2);
    EXPECT_EQ(scene.fluid->density_kg_m3, 1260.);
    EXPECT_EQ(scene.fluid->viscosity_Pa_s, 1.52);
    EXPECT_EQ(scene.fluid->inertia, Inertia::automatic);
    EXPECT_EQ(scene.domain->size_m, (std::array<double, 2>{0.04, 0.02}));
    EXPECT_EQ(scene.domain->walls.size(), 4u);
    EXPECT_EQ(scene.domain->walls.at("left").condition, WallCondition::traction_free);
    EXPECT_EQ(scene.domain->walls.at("top").condition, WallCondition::no_slip);
    EXPECT_EQ(scene.head.magnetization_A_m, 1e5);
    EXPECT_TRUE(scene.head.is_free());
    EXPECT_FALSE(scene.head.young_modulus_Pa.has_value());
    EXPECT_EQ(scene.tail->length_m, 7.5e-3);
    EXPECT_EQ(scene.tail->tip, TipShape::rounded);
    EXPECT_EQ(scene.field.waveform(), FieldProgram::Waveform::sinusoidal);
    EXPECT_DOUBLE_EQ(scene.time.period_s, 1.25);
    EXPECT_EQ(scene.time.n_steps(), 300);
    EXPECT_DOUBLE_EQ(scene.body_length_m(), 8e-3);
    EXPECT_DOUBLE_EQ(scene.head.area_m2(), 0.75e-6);
  }

  TEST(SceneReader, DurationIsASinglePeriod)
  {
    const Scene scene = parse_scene(beam_toml, "scene.toml");
    EXPECT_EQ(scene.time.period_s, 1.);
    EXPECT_EQ(scene.time.periods, 1.);
    EXPECT_EQ(scene.time.n_steps(), 10);
    EXPECT_DOUBLE_EQ(scene.time.time_step_s(), 0.1);
    EXPECT_FALSE(scene.fluid || scene.domain);
    EXPECT_EQ(scene.head.size_m, (std::array<double, 2>{0.1, 0.1}));
  }

  TEST(SceneReader, MeshSizesFollowTheBodyUnlessGiven)
  {
    const Numerics defaults = parse_scene(swimmer_toml, "scene.toml").numerics;
    EXPECT_DOUBLE_EQ(defaults.mesh_size_m, 8e-3 / 60.);
    EXPECT_DOUBLE_EQ(defaults.mesh_size_corner_m, 8e-3 / 240.);
    EXPECT_DOUBLE_EQ(defaults.mesh_size_far_m, 20e-3 / 8.);
    const Numerics given =
        parse_scene(swimmer_toml, "scene.toml", {"numerics.mesh_size_m=2e-4", "numerics.mesh_size_corner_m=0"})
            .numerics;
    EXPECT_DOUBLE_EQ(given.mesh_size_m, 2e-4);
    EXPECT_EQ(given.mesh_size_corner_m, 0.);
  }

  TEST(SceneReader, NumericsInSpaceAreThoseOfTetrahedraUnlessGiven)
  {
    const std::vector<std::string> in_space = {"dimension=3", "head.shape='cylinder'",
                                               "domain.size_m=[40e-3, 20e-3, 20e-3]"};
    const Numerics                 space    = parse_scene(swimmer_toml, "scene.toml", in_space).numerics,
                   plane                    = parse_scene(swimmer_toml, "scene.toml").numerics;
    EXPECT_EQ(space.mesh_growth, 0.5);
    EXPECT_EQ(space.remesh_quality, 0.02);
    EXPECT_TRUE(space.reuse_factorization);
    EXPECT_FALSE(plane.reuse_factorization);
    std::vector<std::string> given = in_space;
    given.insert(given.end(), {"numerics.reuse_factorization=false", "numerics.remesh_quality=0.1"});
    EXPECT_FALSE(parse_scene(swimmer_toml, "scene.toml", given).numerics.reuse_factorization);
    EXPECT_EQ(parse_scene(swimmer_toml, "scene.toml", given).numerics.remesh_quality, 0.1);
  }

  TEST(SceneReader, ChannelIsOpenAtBothEndsByDefault)
  {
    const Scene scene = parse_scene(swimmer_toml, "scene.toml", {"domain.shape=channel", "domain.walls={}"});
    EXPECT_EQ(scene.domain->walls.at("left").condition, WallCondition::traction_free);
    EXPECT_EQ(scene.domain->walls.at("right").condition, WallCondition::traction_free);
    EXPECT_EQ(scene.domain->walls.at("bottom").condition, WallCondition::no_slip);
  }

  TEST(SceneReader, WallTablesCarryTheirParameters)
  {
    const std::string inflow = "left = { condition = \"inflow\", speed_m_s = 0.2, profile = \"uniform\", ramp_s = 2 }";
    const Wall        wall =
        parse_scene(replaced(swimmer_toml, "left = \"traction-free\"", inflow), "scene.toml").domain->walls.at("left");
    EXPECT_EQ(wall.condition, WallCondition::inflow);
    EXPECT_EQ(wall.speed_m_s, 0.2);
    EXPECT_EQ(wall.profile, InflowProfile::uniform);
    EXPECT_EQ(wall.ramp_s, 2.);
  }

  TEST(SceneReader, RigidHeadKeepsItsUnusedModulus)
  {
    const Scene scene =
        parse_scene(swimmer_toml, "scene.toml", {"head.young_modulus_Pa=41e9", "head.poisson_ratio=0.281"});
    EXPECT_EQ(scene.head.young_modulus_Pa, 41e9);
    EXPECT_EQ(scene.head.poisson_ratio, 0.281);
  }

  TEST(SceneReader, EveryChoiceHasAName)
  {
    EXPECT_EQ(to_string(Inertia::automatic), "auto");
    EXPECT_EQ(to_string(MeshMotion::weighted_harmonic), "weighted-harmonic");
    EXPECT_EQ(to_string(FieldProgram::Waveform::sampled), "sampled");
  }

  // -- what is wrong with the text

  TEST(SceneReader, UnknownKeyIsRefusedWithTheNearestName)
  {
    EXPECT_EQ(message_after("viscosity_Pa_s", "viscosity_Pas"),
              "scene.toml:4: [fluid] viscosity_Pas is not a known entry; the nearest known name is viscosity_Pa_s.");
    EXPECT_EQ(message_after("[field]", "[feild]"),
              "scene.toml:23: feild is not a known table; the nearest known name is field.");
    expect_in(message_after("left =", "lefft ="), "scene.toml:9: [domain.walls] lefft is not a known entry");
    expect_in(message_after("left = \"traction-free\"", "left = { condition = \"inflow\", sped_m_s = 1 }"),
              "scene.toml:9: [domain.walls.left] sped_m_s is not a known entry; the nearest known name is speed_m_s");
  }

  TEST(SceneReader, WrongTypeIsRefusedWithTheUnit)
  {
    EXPECT_EQ(message_after("1.52", "\"thick\""),
              "scene.toml:4: [fluid] viscosity_Pa_s = \"thick\" has the wrong type; a number in Pa s is needed.");
    expect_in(message_after("[40e-3, 20e-3]", "[40e-3]"), "an array of two numbers [x, y] in m is needed");
    expect_in(message_after("[40e-3, 20e-3]", "[40e-3, \"b\"]"), "scene.toml:7: [domain] size_m");
    expect_in(message_after("steps_per_period = 100", "steps_per_period = 99.5"),
              "a whole number without point or exponent is needed");
    expect_in(message_after("shape = \"box\"", "shape = 3"),
              "one of \"box\", \"channel\", \"disc\", \"annulus\" is needed");
    expect_in(message_for(swimmer_toml, {"numerics.mirror_meshes=1"}), "true or false is needed");
    expect_in(message_for(swimmer_toml, {"field.program=1"}), "a text in quotes is needed");
    expect_in(message_for(swimmer_toml, {"fluid=3"}), "fluid = 3 must be a table of entries");
  }

  TEST(SceneReader, UnknownChoiceIsRefusedWithTheNearest)
  {
    EXPECT_EQ(
        message_after("\"rectangle\"", "\"rectangel\""),
        "scene.toml:12: [head] shape = \"rectangel\" is not known; the nearest is \"rectangle\" (one of \"rectangle\", "
        "\"disc\", \"ellipse\").");
  }

  TEST(SceneReader, MissingEntryIsNamed)
  {
    EXPECT_EQ(message_after("viscosity_Pa_s = 1.52\n", ""),
              "scene.toml:2: [fluid] viscosity_Pa_s is missing; add it as a number in Pa s.");
    expect_in(message_for("[head]\n"), "scene.toml: dimension is missing");
  }

  TEST(SceneReader, MissingTableIsNamed)
  {
    expect_in(message_for("dimension = 2\n"), "scene.toml: the table [head] is missing");
    expect_in(message_for(beam_toml.substr(0, beam_toml.find("[time]"))), "scene.toml: the table [time] is missing");
  }

  TEST(SceneReader, MalformedTomlIsLocated)
  {
    const std::string message = message_for("dimension = 2\n[fluid\ndensity = 1\n");
    expect_in(message, "scene.toml:2:7: this is not valid TOML: ");
    EXPECT_EQ(message.find('\n'), std::string::npos);
    expect_in(message_after("periods = 3\n", "periods = 3\nperiods = 3\n"), "scene.toml:29:");
  }

  TEST(SceneReader, MissingFileIsNamed)
  {
    EXPECT_EQ(message_of<InputError>([] { read_scene("nowhere.toml"); }),
              "cannot read the scene nowhere.toml: No such file or directory.");
    expect_in(message_of<InputError>([] { read_scene("/"); }), "Is a directory");
  }

  // -- overrides

  TEST(SceneReader, OverridesReplaceAndAddEntries)
  {
    const Scene scene = parse_scene(swimmer_toml, "scene.toml",
                                    {"time.periods=5", "numerics.mesh_motion=harmonic", "tail.tip=\"flat\"",
                                     "head.center_m=[1e-3, 0.0]", "domain.walls.top=traction-free", "time.periods=4"});
    EXPECT_EQ(scene.time.periods, 4.);
    EXPECT_EQ(scene.numerics.mesh_motion, MeshMotion::harmonic);
    EXPECT_EQ(scene.tail->tip, TipShape::flat);
    EXPECT_EQ(scene.head.center_m[0], 1e-3);
    EXPECT_EQ(scene.domain->walls.at("top").condition, WallCondition::traction_free);
  }

  TEST(SceneReader, MessagesOnOverridesNameThem)
  {
    EXPECT_EQ(message_for(swimmer_toml, {"time.step_per_period=40"}),
              "--set time.step_per_period=40: [time] step_per_period is not a known entry; the nearest known name is "
              "steps_per_period.");
    expect_in(message_for(swimmer_toml, {"fluid.viscosity_Pa_s=-1"}),
              "--set fluid.viscosity_Pa_s=-1: [fluid] viscosity_Pa_s");
    expect_in(message_for(swimmer_toml, {"domain.walls.left={condition=\"inflow\"}"}), "--set domain.walls.left=");
  }

  TEST(SceneReader, MalformedOverridesAreRefused)
  {
    for (const char *text : {"time.periods", "=3", "time.=3", ".periods=3", "time..periods=3", ""})
      expect_in(message_for(swimmer_toml, {text}), fmt::format("--set {}: an override reads key.path=value", text));
    expect_in(message_for(swimmer_toml, {"dimension.x=3"}), "dimension is not a table");
  }

  // -- text and digest

  TEST(SceneReader, TextReadsBackAsTheSameScene)
  {
    const Scene scene = parse_scene(swimmer_toml, "scene.toml", {"fluid.viscosity_Pa_s=0.1234567890123456789"});
    const Scene again = parse_scene(scene.text, "scene.toml");
    EXPECT_EQ(scene.text, again.text);
    EXPECT_EQ(scene.hash, again.hash);
    EXPECT_EQ(scene.hash, digest(scene.text));
    EXPECT_EQ(scene.fluid->viscosity_Pa_s, again.fluid->viscosity_Pa_s);
  }

  TEST(SceneReader, DigestDependsOnOverridesButNotOnComments)
  {
    const std::string hash = parse_scene(swimmer_toml, "scene.toml").hash;
    EXPECT_NE(hash, parse_scene(swimmer_toml, "scene.toml", {"time.periods=4"}).hash);
    EXPECT_EQ(hash, parse_scene("# a comment\n" + swimmer_toml, "other.toml").hash);
    EXPECT_EQ(hash, parse_scene(swimmer_toml, "scene.toml", {"time.periods=3"}).hash);
  }

  TEST(SceneReader, ProgramIsRelativeToTheSceneAndPartOfTheDigest)
  {
    const TemporaryFolder folder;
    folder.write("field.csv", program_csv);
    const auto file =
        folder.write("scene.toml", replaced(swimmer_toml, sinusoid, "program = \"field.csv\"\nperiod_s = 2\n"));
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.field.waveform(), FieldProgram::Waveform::sampled);
    EXPECT_EQ(scene.time.period_s, 2.);
    expect_in(scene.text, digest(program_csv));

    folder.write("field.csv", replaced(program_csv, "-1e-3", "-2e-3"));
    EXPECT_NE(read_scene(file).hash, scene.hash);
    folder.write("scene.toml", scene.text);
    expect_in(message_of<InputError>([&] { read_scene(file); }), "has changed since this scene was written");
  }

  TEST(SceneReader, TakesOverThePeriodThatStandsBesideTheProgram)
  {
    const TemporaryFolder folder;
    folder.write("field.csv", program_csv);
    const auto file = folder.write("scene.toml", replaced(swimmer_toml, sinusoid, "program = \"field.csv\"\n"));
    expect_in(message_of<InputError>([&] { read_scene(file); }), "here or in NAME.json beside NAME.csv");
    folder.write("field.json", "{\"period_s\": 2}");
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.time.period_s, 2.);
    std::filesystem::remove(folder.path / "field.json"); // the scene of an output says it by itself
    folder.write("scene.toml", scene.text);
    EXPECT_EQ(read_scene(file).hash, scene.hash);
  }

  TEST(SceneReader, MissingProgramIsNamed)
  {
    expect_in(message_after(sinusoid, "program = \"nowhere.csv\"\nperiod_s = 2\n"),
              "cannot read the field program nowhere.csv");
  }

  TEST(SceneReader, VariantsReplaceEntriesAndOverridesGoBeforeThem)
  {
    const std::string text     = swimmer_toml + "\n[variants.small]\ntime.periods = 1\nhead.density_kg_m3 = 5000.0\n"
                                                "[variants.large]\ntime.periods = 9\n";
    const Scene       as_it_is = parse_scene(text, "scene.toml");
    EXPECT_EQ(as_it_is.text, parse_scene(swimmer_toml, "scene.toml").text) << "unused variants leave no trace";
    const Scene small = parse_scene(text, "scene.toml", {"variant=small"});
    EXPECT_EQ(small.time.periods, 1.);
    EXPECT_EQ(small.head.density_kg_m3, 5000.);
    EXPECT_EQ(small.tail->length_m, as_it_is.tail->length_m);
    EXPECT_EQ(parse_scene(small.text, "scene.toml").hash, small.hash) << "what was solved is a scene of its own";
    EXPECT_EQ(parse_scene(text, "scene.toml", {"time.periods=2", "variant=small"}).time.periods, 2.);
  }

  TEST(SceneReader, UnknownVariantNamesTheKnownOnes)
  {
    const std::string text =
        swimmer_toml + "\n[variants.small]\ntime.periods = 1\n[variants.large]\ntime.periods = 9\n";
    expect_in(message_of<InputError>([&] { parse_scene(text, "scene.toml", {"variant=tiny"}); }),
              "--set variant=tiny: variant = \"tiny\" is not one of \"large\", \"small\".");
    expect_in(message_of<InputError>([&] { parse_scene(swimmer_toml, "scene.toml", {"variant=tiny"}); }),
              "is not known: there is no table [variants]; remove it.");
    expect_in(message_of<InputError>([&] {
                parse_scene(swimmer_toml + "\n[variants.odd]\ntime.periods = -1\n", "scene.toml", {"variant=odd"});
              }),
              "must be positive");
  }
} // namespace swimtwin
