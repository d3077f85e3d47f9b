#include <datasets/scene/scene.h>
#include <datasets/system/error.h>
#include <tests/datasets/example_scenes.h>
#include <tests/datasets/temporary_folder.h>

#include <vector>

namespace swimtwin
{
  namespace
  {
    using Overrides = std::vector<std::string>;

    std::string without(std::string text, const std::string &part)
    {
      const auto position = text.find(part);
      EXPECT_NE(position, std::string::npos) << part;
      return text.erase(position, part.size());
    }

    void expect_refused(const std::string &text, const Overrides &overrides, const std::string &part)
    {
      expect_in(message_of<InputError>([&] { parse_scene(text, "scene.toml", overrides); }), part);
    }
    void expect_refused(const Overrides &overrides, const std::string &part)
    {
      expect_refused(swimmer_toml, overrides, part);
    }
    void expect_accepted(const std::string &text, const Overrides &overrides)
    {
      EXPECT_NO_THROW(parse_scene(text, "scene.toml", overrides));
    }

    const Overrides in_a_disc{"domain={shape=\"disc\", radius_m=0.02}"};
    const Overrides in_space{"dimension=3", "head.shape=cylinder", "domain.size_m=[40e-3, 20e-3, 20e-3]"};
    const Overrides in_an_annulus{"domain={shape=\"annulus\", radius_m=0.02, inner_radius_m=0.005}"};

    Overrides operator+(Overrides a, const Overrides &b)
    {
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }
  } // namespace

  TEST(SceneRules, TwoOrThreeDimensions)
  {
    expect_refused({"dimension=4"}, "dimension = 4 is not a space that swimmers live in; use 2 or 3.");
    expect_refused({"dimension=3"},
                   "size_m = [0.04, 0.02] has the wrong type; an array of three numbers [x, y, z] in m");
    expect_accepted(swimmer_toml, in_space);
    expect_refused(in_space + Overrides{"domain.size_m=[40e-3, 20e-3]"}, "an array of three numbers [x, y, z]");
    expect_refused(in_space + Overrides{"gravity={acceleration_m_s2=[0]}"}, "an array of three numbers [x, y, z]");
    expect_refused({"gravity={acceleration_m_s2=[0, 0, -9.81]}"}, "an array of two numbers [x, y]");
    expect_accepted(swimmer_toml, in_space + Overrides{"numerics.coupling=fixed-point"});
    expect_accepted(swimmer_toml, {"dimension=3", "head.shape=cylinder",
                                   "domain={shape=\"cylinder\", radius_m=0.01, length_m=0.04}"});
    expect_refused({"dimension=3", "head.shape=cylinder", "domain={shape=\"cylinder\", radius_m=0.01}"},
                   "length_m is missing; the shape cylinder needs it, in m");
    expect_refused({"head.shape=cylinder"}, "[head] shape = \"cylinder\" is not known");
    expect_refused({"dimension=3", "domain.size_m=[40e-3, 20e-3, 20e-3]"}, "[head] shape = \"rectangle\" is not known");
  }

  TEST(SceneRules, QuantitiesThatMustBePositive)
  {
    for (const char *key :
         {"fluid.density_kg_m3", "fluid.viscosity_Pa_s", "head.density_kg_m3", "tail.length_m", "tail.root_height_m",
          "tail.tip_height_m", "tail.young_modulus_Pa", "tail.density_kg_m3", "field.frequency_Hz", "time.periods",
          "head.young_modulus_Pa", "numerics.mesh_size_m", "numerics.mesh_size_far_m", "numerics.mesh_growth"})
      for (const char *value : {"=0.0", "=-1.0"})
        expect_refused({key + std::string(value)}, "is out of range; it must be positive");
    expect_refused({"head.size_m=[0.0, 1.0]"}, "it must be positive (unit: m)");
    expect_refused({"domain.size_m=[1.0, -1.0]"}, "it must be positive (unit: m)");
    expect_refused(beam_toml, {"head.diameter_m=0"}, "it must be positive (unit: m)");
    expect_refused(beam_toml, {"time.duration_s=0"}, "it must be positive (unit: s)");
    expect_refused(in_a_disc + Overrides{"domain.radius_m=-1"}, "it must be positive (unit: m)");
  }

  TEST(SceneRules, QuantitiesThatMustNotBeNegative)
  {
    for (const char *key : {"field.ramp_s", "numerics.mesh_size_corner_m"})
      expect_refused({key + std::string("=-1.0")}, "must not be negative");
    for (const char *key : {"numerics.remesh_every_steps", "output.snapshots_per_period", "output.fields_per_period"})
      expect_refused({key + std::string("=-1")}, "must not be negative");
    expect_refused(beam_toml, {"gravity={acceleration_m_s2=[0,-2], ramp_s=-1}"}, "must not be negative");
  }

  TEST(SceneRules, NumbersMustBeFinite)
  {
    expect_refused({"fluid.viscosity_Pa_s=nan"}, "[fluid] viscosity_Pa_s = nan is out of range");
    expect_refused({"fluid.viscosity_Pa_s=inf"}, "is out of range");
    expect_refused({"field.bx_T=inf"}, "must be a finite number");
  }

  TEST(SceneRules, PoissonRatioIsBounded)
  {
    for (const char *value : {"0.5", "-1", "2"})
      expect_refused({std::string("tail.poisson_ratio=") + value}, "it must lie between -1 and 0.5, both excluded");
    expect_accepted(swimmer_toml, {"tail.poisson_ratio=0.49"});
    expect_refused({"head.poisson_ratio=0.5"}, "it must lie between -1 and 0.5");
  }

  TEST(SceneRules, NumericalSettingsAreBounded)
  {
    expect_refused({"numerics.tail_order=3"}, "it must be 1 or 2");
    expect_refused({"numerics.remesh_quality=1"}, "it must be at least 0 and less than 1");
    expect_refused({"numerics.coupling_tolerance=0"}, "it must lie between 0 and 1");
    expect_refused({"numerics.linear_tolerance=1"}, "it must lie between 0 and 1");
    expect_refused({"numerics.max_coupling_iterations=0"}, "it must be at least 1");
    expect_refused({"numerics.max_step_halvings=21"}, "it must lie between 0 and 20");
    expect_refused({"numerics.mesh_growth=2"}, "it must be positive and at most 1");
    expect_refused({"time.steps_per_period=99999999999"}, "is out of range");
  }

  TEST(SceneRules, InertiaNamesTermsOfItsOwn)
  {
    expect_refused({"fluid.inertia=[\"convectiv\"]"}, "the nearest is \"convective\"");
    expect_refused({"fluid.inertia=[\"tail\", \"tail\"]"}, "names \"tail\" twice");
    expect_refused({"fluid.inertia=[1]"}, "an array of some of");
    expect_refused({"tail.inertia=full"}, "write [fluid] inertia instead");
    expect_refused({"fluid.inertia=full", "numerics.coupling=fixed-point"}, "cannot be \"fixed-point\" with inertia");
  }

  TEST(SceneRules, ASteadyStateNeedsAHeldHeadAndNoTime)
  {
    expect_refused({"time.steady=true"}, "does not go with steady = true");
  }

  // There is nothing to solve in turn, and nothing of the baseline's limits holds.
  TEST(SceneRules, OnlyAnElasticTailIsPartitioned)
  {
    const Overrides asked{"numerics.coupling=fixed-point"};
    EXPECT_TRUE(parse_scene(swimmer_toml, "elastic", asked + Overrides{"fluid.inertia=none"}).is_partitioned());
    EXPECT_FALSE(parse_scene(swimmer_toml, "monolithic").is_partitioned());
    const Scene rigid = parse_scene(swimmer_toml, "rigid", asked + Overrides{"tail.law=rigid", "fluid.inertia=full"});
    EXPECT_FALSE(rigid.is_partitioned());
    EXPECT_EQ(rigid.numerics.max_coupling_iterations, Numerics{}.max_coupling_iterations);
  }

  TEST(SceneRules, PartitionedCouplingNeedsAnOpenDomain)
  {
    expect_refused({"numerics.coupling=fixed-point", "domain.walls.left=no-slip", "domain.walls.right=no-slip"},
                   "cannot be \"fixed-point\" in a domain without a traction-free wall");
    expect_refused({"numerics.acceleration=anderson"}, "\"aitken\"");
    expect_refused({"numerics.relaxation=0"}, "it must lie between 0, excluded, and 1");
  }

  TEST(SceneRules, AWrongTableIsBlamedOnTheOverrideInIt)
  {
    expect_refused({"domain.size_m=[1e-3, 1e-3]"},
                   "--set domain.size_m=[1e-3, 1e-3]: [domain] does not contain the swimmer");
  }

  // -- parts

  TEST(SceneRules, FluidAndDomainComeTogether)
  {
    expect_refused(beam_toml, {"fluid={density_kg_m3=1, viscosity_Pa_s=1}"}, "[fluid] needs a [domain]");
    expect_refused(beam_toml, {"domain={shape=\"disc\", radius_m=2}"}, "[domain] needs a [fluid]");
  }

  TEST(SceneRules, ARigidHeadAloneIsNothingToSolve)
  {
    const std::string alone =
        "dimension = 2\n[head]\nshape = \"disc\"\ndiameter_m = 1\nmotion = \"fixed\"\n[time]\nduration_s = "
        "1\nsteps = 1\n";
    expect_refused(alone, {}, "scene.toml:2: [head] is rigid and alone");
  }

  TEST(SceneRules, AHeadInVacuumMustBeFixed)
  {
    expect_refused(beam_toml, {"head.motion=free"}, "[head] motion = \"free\" has nothing to hold the head");
    expect_refused(without(beam_toml, "motion = \"fixed\"\n"), {}, "scene.toml:2: [head] motion must be \"fixed\"");
  }

  TEST(SceneRules, AFreeHeadNeedsADensity)
  {
    const std::string text = without(swimmer_toml, "density_kg_m3 = 7000.0\n");
    expect_refused(text, {}, "[head] density_kg_m3 is missing");
    expect_accepted(text, {"head.motion=fixed"});
  }

  TEST(SceneRules, ASwimmerThatNothingDrivesIsAScene)
  {
    expect_accepted(beam_toml, {});
    expect_accepted(swimmer_toml, {"head.magnetization_A_m=0"});
  }

  // -- shapes

  TEST(SceneRules, HeadsHaveTheLengthsOfTheirShape)
  {
    expect_refused({"head.shape=disc"},
                   "[head] size_m = [0.0005, 0.0015] does not belong to the shape disc; give diameter_m.");
    expect_refused({"head.diameter_m=1"}, "diameter_m = 1 does not belong to the shape rectangle; give size_m.");
    expect_refused(without(beam_toml, "diameter_m = 0.1\n"), {},
                   "[head] diameter_m is missing; the shape disc needs it");
    expect_refused(without(swimmer_toml, "size_m = [0.5e-3, 1.5e-3]\n"), {}, "[head] size_m is missing");
  }

  TEST(SceneRules, DomainsHaveTheLengthsOfTheirShape)
  {
    expect_refused({"domain.shape=disc"}, "size_m");
    expect_refused({"domain.radius_m=1"}, "[domain] radius_m = 1 does not belong to the shape box");
    expect_refused(in_a_disc + Overrides{"domain.inner_radius_m=1e-3"},
                   "inner_radius_m = 0.001 does not belong to the shape disc");
    expect_refused({"domain={shape=\"disc\"}"}, "[domain] radius_m is missing; the shape disc needs it, in m");
    expect_refused({"domain={shape=\"annulus\", radius_m=1}"}, "[domain] inner_radius_m is missing");
    expect_refused({"domain={shape=\"annulus\", radius_m=1, inner_radius_m=1}"}, "is not smaller than radius_m = 1 m");
  }

  TEST(SceneRules, TheTailStartsOnTheHead)
  {
    expect_refused({"tail.root_height_m=1.6e-3"}, "is larger than the head's height of 0.0015 m");
  }

  TEST(SceneRules, InSpaceNoGapIsTooFineForTetrahedra)
  {
    expect_refused(in_space + Overrides{"domain.size_m=[40e-3, 1.502e-3, 20e-3]"},
                   "leaves 1e-06 m between the swimmer and the");
    expect_accepted(swimmer_toml, {"domain.size_m=[40e-3, 1.502e-3]"});
  }

  TEST(SceneRules, TheTailDoesNotWiden)
  {
    expect_refused({"tail.tip_height_m=1.51e-3"}, "is larger than root_height_m = 0.0015 m");
  }

  TEST(SceneRules, TheRoundedTipIsShorterThanTheTail)
  {
    const Overrides short_tail{"tail.length_m=1e-4"};
    expect_refused(short_tail,
                   "rounded tip of radius 0.0001 m that is not shorter than the tail (length_m = 0.0001 m)");
    expect_accepted(swimmer_toml, short_tail + Overrides{"tail.tip=flat"});
  }

  TEST(SceneRules, TheTailsSidesLeaveARoundHead)
  {
    const Overrides ellipse{"head.shape=ellipse", "head.size_m=[2e-3, 1.5e-3]"};
    expect_refused(ellipse, "lets the tail's tapering sides cut into the head's curve");
    expect_accepted(swimmer_toml, ellipse + Overrides{"tail.root_height_m=1e-3"});
  }

  // -- walls

  TEST(SceneRules, WallsBelongToTheirShape)
  {
    expect_refused({"domain.walls.outer=no-slip"}, "[domain.walls] outer is not a known entry");
    expect_refused(in_a_disc + Overrides{"domain.walls.left=no-slip"},
                   "[domain.walls] left is not a known entry; the nearest");
    expect_refused({"domain.walls.left=sticky"}, "[domain.walls] left = \"sticky\" is not known");
  }

  TEST(SceneRules, InflowsNeedAStraightWall)
  {
    expect_refused(in_a_disc + Overrides{"domain.walls.outer={condition=\"inflow\", speed_m_s=1}"},
                   "inflows need a straight wall");
  }

  TEST(SceneRules, AFreeSwimmerWithoutInertiaNeedsAWallThatHoldsTheFluid)
  {
    const std::string open = "domain.walls={left=\"traction-free\", right=\"traction-free\", "
                             "bottom=\"traction-free\", top=\"traction-free\"}";
    expect_refused({open, "fluid.inertia=none"}, "[domain.walls] leaves every wall traction-free");
    for (const char *inertia : {"fluid.inertia=full", "fluid.inertia=[\"head\"]"})
      expect_accepted(swimmer_toml, {open, inertia});
    expect_accepted(swimmer_toml, {open, "fluid.inertia=none", "domain.walls.top=no-slip"});
    expect_accepted(swimmer_toml, {open, "fluid.inertia=none", "head.motion=fixed"});
  }

  TEST(SceneRules, HeadsNeedAThickness)
  {
    expect_refused({"head.size_m=[1e-300, 1.5e-3]"}, "[head] size_m = [1e-300, 0.0015] m is too thin to be meshed");
    expect_accepted(swimmer_toml, {"head.size_m=[1e-8, 1.5e-3]"});
  }

  TEST(SceneRules, InflowsNeedAnOutflow)
  {
    expect_refused({"domain.walls.right=no-slip", "domain.walls.left={condition=\"inflow\", speed_m_s=1}"},
                   "is an inflow, but the fluid cannot leave; make at least one other wall \"traction-free\".");
  }

  TEST(SceneRules, MovingWallsAndInflowsNeedASpeed)
  {
    expect_refused({"domain.walls.left=inflow"},
                   "has no speed; write left = { condition = \"inflow\", speed_m_s = ... }.");
    expect_refused({"domain.walls.top={condition=\"moving-wall\"}"}, "has no speed");
    expect_accepted(swimmer_toml, {"domain.walls.top={condition=\"moving-wall\", speed_m_s=1e-3}"});
  }

  TEST(SceneRules, WallParametersBelongToTheirCondition)
  {
    expect_refused({"domain.walls.top={condition=\"no-slip\", speed_m_s=1}"},
                   "speed_m_s = 1 does not belong to a no-slip wall");
    expect_refused({"domain.walls.top={condition=\"no-slip\", ramp_s=1}"},
                   "ramp_s = 1 does not belong to a no-slip wall");
    expect_refused({"domain.walls.top={condition=\"moving-wall\", speed_m_s=1, profile=\"uniform\"}"},
                   "profile = \"uniform\" belongs to an inflow only");
    expect_refused({"domain.walls.top={speed_m_s=1}"}, "[domain.walls.top] condition is missing");
  }

  TEST(SceneRules, OnlyANoSlipDiscMovesWithTheSwimmer)
  {
    expect_refused({"domain.moves_with_swimmer=true"}, "is for the shape disc only");
    expect_refused(in_a_disc + Overrides{"domain.moves_with_swimmer=true", "domain.walls.outer=traction-free"},
                   "needs a no-slip outer wall");
    expect_accepted(swimmer_toml, in_a_disc + Overrides{"domain.moves_with_swimmer=true", "head.center_m=[1e-3, 0]"});
  }

  // -- clearance

  TEST(SceneRules, TheSwimmerIsInsideTheBox)
  {
    // tip at 7.75 mm + 13 mm, half circle of radius 0.1 mm; right wall at 20 mm
    expect_refused({"head.center_m=[13e-3, 0]"},
                   "which reaches 0.00075 m beyond the right wall; enlarge the domain, or move");
    expect_refused({"head.center_m=[0, 9.3e-3]"}, "which reaches 5e-05 m beyond the top wall");
    expect_refused({"head.center_m=[-20e-3, 0]"}, "beyond the left wall");
    expect_accepted(swimmer_toml, {"head.center_m=[12.2e-3, 0]"});
  }

  TEST(SceneRules, CentresInSpaceAreInThePlaneOfMotion)
  {
    expect_accepted(swimmer_toml, in_space + Overrides{"head.center_m=[1e-3, 2e-3, 0.0]", "domain.center_m=[0, 0, 0]"});
    for (const char *table : {"head", "domain"})
      expect_refused(in_space + Overrides{std::string(table) + ".center_m=[0.0, 0.0, 1e-3]"},
                     std::string("[") + table + "] center_m = [0, 0, 0.001] is off the plane z = 0");
    expect_refused({"head.center_m=[0.0, 0.0, 0.0]"}, "an array of two numbers [x, y]");
  }

  TEST(SceneRules, ASwimmerInSpaceIsInsideItsBox)
  {
    const auto deep = [&](const char *depth) {
      return in_space + Overrides{std::string("domain.size_m=[40e-3, 20e-3, ") + depth + "]"};
    };
    expect_refused(deep("1.2e-3"), "reaches 0.00015 m beyond the front wall; enlarge the domain");
    expect_refused(deep("1.5e-3"), "touches the front wall");
    expect_accepted(swimmer_toml, deep("1.6e-3"));
  }

  // Turned by a right angle about a centre at y = 3 mm, a head 0.5 mm long and 1.5 mm wide has its rim at y = 3.25 mm
  // and at distances up to 0.75 mm beside it.
  TEST(SceneRules, ASwimmerInSpaceIsInsideItsVesselAllAround)
  {
    const auto vessel = [](const char *radius) {
      return Overrides{"dimension=3",
                       "head.shape=cylinder",
                       "head.center_m=[0.0, 3e-3]",
                       "head.angle_rad=1.5707963267948966",
                       "tail.length_m=1e-3",
                       std::string("domain={shape=\"cylinder\", length_m=0.04, radius_m=") + radius + "}"};
    };
    expect_accepted(swimmer_toml, vessel("4.3e-3"));
    expect_refused(vessel("4.2e-3"), "beyond the outer wall");
    expect_refused(vessel("4.2e-3") + Overrides{"head.angle_rad=-1.5707963267948966", "tail.length_m=0.5e-3",
                                                "domain.radius_m=3.3e-3"},
                   "reaches 3.542e-05 m beyond the outer wall"); // hypot(3.25, 0.75) - 3.3 mm
  }

  TEST(SceneRules, AProfileIsAWholeTail)
  {
    const auto profile = [](const std::string &points) {
      return Overrides{"tail={profile_m=" + points + ", law=\"rigid\", density_kg_m3=1300.0}"};
    };
    const Overrides swelling = profile("[[0.0, 0.3e-3], [3e-3, 1.2e-3], [6e-3, 0.2e-3]]");
    const Scene     scene    = parse_scene(swimmer_toml, "scene.toml", swelling);
    EXPECT_DOUBLE_EQ(scene.tail->length_m, 6.2e-3);
    EXPECT_DOUBLE_EQ(scene.tail->root_height_m, 0.6e-3);
    EXPECT_DOUBLE_EQ(scene.tail->tip_height_m, 0.4e-3);
    expect_refused(in_space + swelling + Overrides{"domain.size_m=[40e-3, 20e-3, 2.2e-3]"},
                   "reaches 0.0001 m beyond the front wall");
    expect_refused(swelling + Overrides{"tail.length_m=6e-3"}, "does not go with profile_m, which says it");
    expect_refused(profile("[[0.0, 0.3e-3]]"), "has one point; give at least two");
    expect_refused(profile("[[1e-3, 0.3e-3], [2e-3, 0.3e-3]]"), "its first distance must be 0");
    expect_refused(
        profile("[[0.0, 0.3e-3], [2e-3, 0.3e-3], [2e-3, 0.2e-3]]"),
        "goes from 0.002 m to 0.002 m; distances must grow from point to point: leave out one, or part them.");
    expect_refused(profile("[[0.0, 0.3e-3], [2e-3, 0.3e-3], [1e-3, 0.2e-3]]"), "from point to point: sort them.");
    expect_refused({"tail.tip_height_m=0"}, "elements end in no point: blunt the tip (unit: m)");
    expect_refused(profile("[[0.0, 0.3e-3], [2e-3, 0.0]]"),
                   "has the radius 0 m at 0.002 m; every radius must be positive");
    expect_refused(profile("[[0.0, 0.3e-3], [1e-3, -0.3e-3], [2e-3, 0.1e-3]]"),
                   "has the radius -0.0003 m at 0.001 m; every radius must be positive");
    expect_refused(profile("[]"), "an array of points [[x, y], ...] in m");
    expect_refused(profile("[[0.0, 0.3e-3], [2e-3]]"), "an array of points [[x, y], ...] in m");
    expect_refused(profile("[[0.0, 0.8e-3], [2e-3, 0.1e-3]]"), "the tail must start on the head");
    expect_refused(profile("[[0.0, 0.6e-3], [0.4e-3, 0.1e-3], [2e-3, 0.1e-3]]") +
                       Overrides{"head={shape=\"disc\", diameter_m=1.5e-3, density_kg_m3=7000.0}"},
                   "cut into the head's curve");
  }

  TEST(SceneRules, ATailInSpaceIsAsThickAsItsElements)
  {
    const auto tip = [](const std::string &height) { return in_space + Overrides{"tail.tip_height_m=" + height}; };
    expect_accepted(swimmer_toml, tip("1.6e-6"));
    expect_refused(tip("1.4e-6"), "[tail] tip_height_m = 1.4e-06 m is too thin for elements of a tail of 0.0075 m; at "
                                  "least 1.5e-06 m are needed: blunt it.");
    expect_accepted(swimmer_toml, {"tail.tip_height_m=1.4e-6"});
    expect_refused(in_space +
                       Overrides{"tail={profile_m=[[0.0, 0.3e-3], [3e-3, 0.4e-6], [6e-3, 0.2e-3]], law=\"rigid\", "
                                 "density_kg_m3=1300.0}"},
                   "is 8e-07 m thick where it is thinnest");
  }

  TEST(SceneRules, ATailInSpaceLeavesARoundHeadAtAnAngle)
  {
    const auto sphere = [](const char *root) {
      return in_space + Overrides{"head={shape=\"sphere\", diameter_m=1.5e-3, density_kg_m3=7000.0}",
                                  std::string("tail.root_height_m=") + root};
    };
    expect_refused(sphere("1.49e-3"), "an angle of 2 degrees, too thin a wedge to be meshed; at least 8.6 degrees");
    expect_accepted(swimmer_toml, sphere("1.45e-3"));
  }

  TEST(SceneRules, AFilmFitsInTheBackOfACylinder)
  {
    const Overrides film =
        in_space + Overrides{"tail.section=rectangular", "tail.root_height_m=0.2e-3", "tail.width_m=1.2e-3"};
    expect_accepted(swimmer_toml, film);
    EXPECT_EQ(parse_scene(swimmer_toml, "scene.toml", film).tail->tip, TipShape::flat);
    expect_refused(film + Overrides{"tail.width_m=1.6e-3"}, "corners are 0.001612 m apart, which does not fit");
    expect_refused(film + Overrides{"tail.tip=rounded"}, "a rectangular one has straight sides and a flat tip");
    expect_refused(film + Overrides{"domain.size_m=[40e-3, 20e-3, 1.4e-3]"}, "beyond the front wall");
    expect_refused(film + Overrides{"head={shape=\"sphere\", diameter_m=1.5e-3, density_kg_m3=7000.0}"},
                   "needs a head with a flat back");
    expect_refused(in_space + Overrides{"tail.width_m=1e-3"}, "belongs to a rectangular section");
    expect_refused(in_space + Overrides{"tail.section=rectangular"}, "width_m is missing");
    expect_refused({"tail.section=rectangular"}, "is for three dimensions");
  }

  TEST(SceneRules, AShearFlowHasARateAndNoInertiaWhereTheDomainMoves)
  {
    const auto outer = [](const char *wall) {
      return Overrides{"domain={shape=\"disc\", radius_m=0.02, moves_with_swimmer=true}",
                       std::string("domain.walls.outer=") + wall};
    };
    const char *shear = "{condition=\"shear-flow\", shear_rate_1_s=1.0}";
    expect_accepted(swimmer_toml, outer(shear) + Overrides{"fluid.inertia=none"});
    expect_refused(outer(shear) + Overrides{"fluid.inertia=full"}, "does not go with a shear flow that has inertia");
    expect_refused(outer("{condition=\"shear-flow\"}"), "has no rate; write outer = {");
    expect_refused(outer("{condition=\"no-slip\", shear_rate_1_s=1.0}"), "belongs to a shear flow only");
    expect_refused(outer("{condition=\"shear-flow\", shear_rate_1_s=1.0, speed_m_s=1.0}"), "remove it");
  }

  TEST(SceneRules, MeshesInSpaceHaveNoMoreTetrahedraThanAMachineHolds)
  {
    expect_refused(in_space + Overrides{"numerics.mesh_size_m=1e-5"}, "tetrahedra; at most 3e+06 are possible");
    expect_accepted(swimmer_toml, in_space + Overrides{"numerics.mesh_size_m=2e-4"});
  }

  TEST(SceneRules, TheInitialAngleCounts)
  {
    const Overrides lifted{"head.center_m=[13e-3, 0]", "head.angle_rad=1.5707963267948966"};
    expect_accepted(swimmer_toml, lifted);
    expect_refused(lifted + Overrides{"head.center_m=[0, 3e-3]"}, "which reaches 0.00075 m beyond the top wall");
    expect_refused(lifted + Overrides{"head.center_m=[0, -9.8e-3]"}, "which reaches 5e-05 m beyond the bottom wall");
  }

  TEST(SceneRules, TouchingAWallIsRefused)
  {
    expect_refused({"head.center_m=[-19.75e-3, 0]"}, "which touches the left wall");
  }

  TEST(SceneRules, TheSwimmerIsInsideTheDisc)
  {
    expect_refused(in_a_disc + Overrides{"head.center_m=[13e-3, 0]"}, "which reaches 0.00075 m beyond the outer wall");
    expect_accepted(swimmer_toml, in_a_disc);
  }

  TEST(SceneRules, TheSwimmerFitsBetweenTheCircles)
  {
    expect_refused(in_an_annulus + Overrides{"head.center_m=[-4e-3, 5.2e-3]"}, "beyond the inner wall");
    expect_refused(in_an_annulus + Overrides{"domain.inner_radius_m=1e-6", "head.center_m=[0, 0]"},
                   "beyond the inner wall");
    expect_refused(in_an_annulus + Overrides{"domain.inner_radius_m=1e-6", "head.center_m=[-4e-3, 0]"},
                   "beyond the inner wall");
    expect_accepted(swimmer_toml, in_an_annulus + Overrides{"head.center_m=[-4e-3, 12e-3]"});
  }

  // -- field and time

  TEST(SceneRules, FieldEntriesBelongToTheWaveform)
  {
    expect_refused({"field.waveform=constant"}, "[field] frequency_Hz = 0.8 does not belong to a constant field");
    expect_refused({"field.waveform=sampled"}, "[field] waveform = \"sampled\" cannot be chosen here");
    expect_refused({"field.period_s=1"}, "[field] period_s = 1 goes with a program only");
    expect_refused({"field.program=a.csv"}, "[field] bx_T = 0.005 does not go with a program");
    expect_refused({"field={program=\"a.csv\"}"}, "[field] period_s is missing; a program needs the period");
    expect_refused(without(swimmer_toml, "by_T = 5e-3\n"), {}, "[field] by_T is missing; give both components");
    expect_refused(without(swimmer_toml, "frequency_Hz = 0.8\n"), {},
                   "[field] frequency_Hz is missing; a sinusoidal field needs");
  }

  TEST(SceneRules, AFieldAlongZAndAMagnetAcrossAreForThreeDimensions)
  {
    expect_refused({"head.magnetization_direction=[0.0, 1.0, 0.0]"},
                   "[head] magnetization_direction = [0, 1, 0] is for three dimensions");
    expect_refused(in_space + Overrides{"head.magnetization_direction=[0.0, 0.0, 0.0]"},
                   "[head] magnetization_direction = [0, 0, 0] has no direction");
    expect_refused(in_space + Overrides{"head.magnetization_direction=[0.0, 0.0, 1.0]", "numerics.symmetric_half=on"},
                   "needs a scene that is its own mirror image, but the head's magnetization has a component along z");
    expect_accepted(swimmer_toml, in_space + Overrides{"head.magnetization_direction=[0.0, 2.0, 0.0]"});
    const Overrides cone{"field.bz_T=5e-3", "field.bz_phase_rad=1.57"};
    expect_refused(cone, "[field] bz_T = 0.005 is not zero, which turns the swimmer out of the plane; set bz_T to "
                         "zero, or use dimension = 3.");
    expect_accepted(swimmer_toml, {"field.bz_T=0.0"});
    expect_accepted(swimmer_toml, in_space + cone);
    expect_refused(in_space + Overrides{"field.bz_phase_rad=1.57"},
                   "[field] bz_phase_rad = 1.57 is the phase of bz_T, which is missing; add it, or remove this.");
    expect_refused(in_space + cone + Overrides{"numerics.symmetric_half=on"},
                   "needs a scene that is its own mirror image, but the field has a component along z");
    expect_refused({"field={waveform=\"constant\", bx_T=1e-3, by_T=0.0, bz_T=0.0, bz_phase_rad=1.0}"},
                   "[field] bz_phase_rad = 1 does not belong to a constant field; remove it.");
    expect_refused({"field={program=\"a.csv\", period_s=1.0, bz_T=1e-3}"},
                   "[field] bz_T = 0.001 does not go with a program");
    expect_refused(in_space + Overrides{"field.bz_T=nan"},
                   "[field] bz_T = nan is out of range; it must be a finite number");
  }

  TEST(SceneRules, AFieldProgramInThePlaneHasNothingAlongZ)
  {
    const TemporaryFolder folder;
    const auto program = folder.write("turn.csv", "time_s,bx_T,by_T,bz_T\n0,1e-3,0,0\n1,0,0,1e-3\n2,0,0,0\n3,0,0,0\n");
    const Overrides played{"field={program=\"" + program.string() + "\", period_s=4.0}"};
    expect_refused(played, "has values of bz_T that are not zero, which turns the swimmer out of the plane");
    expect_accepted(swimmer_toml, in_space + played);
  }

  TEST(SceneRules, PeriodicFieldsCountPeriods)
  {
    expect_refused(
        {"time.duration_s=1"},
        "[time] duration_s = 1 does not go with a periodic field or motion; give periods and steps_per_period.");
    expect_refused(without(swimmer_toml, "periods = 3\n"), {},
                   "[time] periods is missing; with a periodic field or motion");
    expect_refused(without(swimmer_toml, "steps_per_period = 100\n"), {}, "[time] steps_per_period is missing");
  }

  TEST(SceneRules, OtherScenesHaveADuration)
  {
    expect_refused(beam_toml, {"time.periods=1"},
                   "[time] periods = 1 needs a periodic field or motion; give duration_s and steps.");
    expect_refused(without(beam_toml, "duration_s = 1.0\n"), {},
                   "[time] duration_s is missing; without a periodic field or motion");
    expect_refused(without(beam_toml, "steps = 10\n"), {}, "[time] steps is missing");
    expect_accepted(beam_toml, {"field={waveform=\"constant\", bx_T=0.01, by_T=0.0}"});
  }

  TEST(SceneRules, ASwingNeedsEnoughSteps)
  {
    expect_refused(
        {"time.steps_per_period=4"},
        "[time] steps_per_period = 4 gives 2 steps per half swing; at least 10 steps per period are needed.");
    expect_accepted(swimmer_toml, {"time.steps_per_period=10"});
  }

  TEST(SceneRules, StepsAreWholeAndNotTooMany)
  {
    expect_refused({"time.periods=0.123"},
                   "[time] periods = 0.123 of 100 steps gives 12.3 steps; choose a whole number");
    expect_refused({"time.periods=1e12"}, "[time] periods = 1000000000000 gives 1e+14 steps; at most");
    expect_accepted(swimmer_toml, {"time.periods=0.5"});
  }

  TEST(SceneRules, MeshSizesAreOrdered)
  {
    expect_refused({"numerics.mesh_size_corner_m=1e-3"}, "is larger than on the surface (0.00013");
    expect_refused({"numerics.mesh_size_far_m=1e-5"}, "[numerics] mesh_size_far_m = 1e-05 m: the mesh size far away");
  }

  // A mesher that is asked for them ends hours later, or never.
  TEST(SceneRules, MeshesHaveNoMoreTrianglesThanAMachineHolds)
  {
    expect_refused({"domain.size_m=[1e300, 1e300]"}, "[domain] is 1.25e+302 body lengths long; at most 1e+06");
    expect_refused({"domain.size_m=[9.0, 9.0]", "numerics.mesh_size_far_m=1e-3"},
                   "[numerics] mesh_size_far_m = 0.001 m would make a mesh of about 2e+08 triangles; at most 1e+07");
    expect_refused({"numerics.mesh_size_m=1e-9", "numerics.mesh_size_corner_m=1e-9"}, "would make a mesh of about");
    expect_refused({"numerics.mesh_growth=1e-8", "numerics.mesh_size_m=1e-7", "numerics.mesh_size_corner_m=1e-7"},
                   "would make a mesh of about");
  }

  TEST(SceneRules, HalfOfASceneIsSolvedOnlyWhereItTellsTheOtherHalf)
  {
    const Overrides on{"numerics.symmetric_half=on"}, aligned{"field.by_T=0.0"};
    expect_refused(on, "symmetric_half = \"on\" needs a scene that is its own mirror image, but the field acts across "
                       "the axis; use \"auto\" or \"off\".");
    expect_refused(on + aligned + Overrides{"numerics.coupling=fixed-point"},
                   "symmetric_half = \"on\" does not go with coupling = \"fixed-point\", which solves the whole scene; "
                   "use \"off\", or coupling = \"monolithic\".");
    expect_accepted(swimmer_toml, on + aligned);
    expect_refused({"numerics.symmetric_half=half"}, "symmetric_half");
  }

  TEST(SceneRules, GivenMotionsStandWhereTheyAreAskedFor)
  {
    const std::string oscillation = "head.oscillation={frequency_Hz=1.0, amplitude_m=[1e-3,0]}";
    const std::string wave        = "tail.wave={angle_rad=0.5, frequency_Hz=1.0}";
    expect_refused({"head.motion=\"prescribed\""},
                   "[head] oscillation is missing; [head] motion = \"prescribed\" needs its motion.");
    expect_refused({oscillation}, "is not used; set [head] motion = \"prescribed\", or remove it.");
    expect_refused({"tail.law=\"prescribed\""}, "[tail] wave is missing");
    expect_refused({wave}, "is not used; set [tail] law = \"prescribed\", or remove it.");
    expect_refused({"head.motion=\"prescribed\"", "head.oscillation={amplitude_m=[1e-3,0]}"},
                   "frequency_Hz is missing");
    expect_accepted(swimmer_toml, {"head.motion=\"prescribed\"", oscillation});
    expect_accepted(swimmer_toml, {"tail.law=\"prescribed\"", wave});
  }

  TEST(SceneRules, GivenShapesNeedRoomInTheFluid)
  {
    const Overrides waving{"tail.law=\"prescribed\"", "tail.wave={angle_rad=0.5, frequency_Hz=1.0}"};
    expect_refused(waving + in_a_disc, "without a traction-free wall");
    expect_refused(waving + Overrides{"numerics.tail_order=1"}, "is for an elastic tail");
  }
} // namespace swimtwin
