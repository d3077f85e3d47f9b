#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/text/csv_table.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

namespace swimtwin
{
  namespace
  {
    const std::filesystem::path datasets = std::filesystem::path(places::scenes).parent_path();

    Scene reference(std::vector<std::string> overrides = {})
    {
      return read_scene(datasets / "scenes/reference-2d-paper.toml", overrides);
    }

    /// Displacements (m) of one swimmer with some terms of inertia.
    struct MeasuredSwimmer
    {
      Scene                         scene;
      std::map<std::string, double> displacement_m;

      /// Share of the displacement that is lost by keeping these terms alone.
      double lost(const std::string &kept) const { return 1. - displacement_m.at(kept) / displacement_m.at("full"); }
    };

    /// The keys that a scene is set to by a table's columns.
    struct TableKey
    {
      const char *column, *key;
    };
    const std::vector<TableKey> keys_in_plane{{"magnetization_A_m", "head.magnetization_A_m"},
                                              {"viscosity_Pa_s", "fluid.viscosity_Pa_s"},
                                              {"frequency_Hz", "field.frequency_Hz"}};

    std::vector<MeasuredSwimmer> measured(const std::string &table_name, const std::string &scene,
                                          const std::vector<TableKey> &keys)
    {
      const CsvTable table = CsvTable::read(datasets / "reference" / table_name);
      const auto     terms = table.find_column("terms").value();
      std::map<std::vector<std::string>, std::map<std::string, double>> found;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
      {
        std::vector<std::string> overrides{"fluid.inertia=auto"};
        for (const auto &[column, key] : keys)
          overrides.push_back(std::string(key) + "=" + table.cells(row)[table.find_column(column).value()]);
        found[overrides][table.cells(row)[terms]] = table.number(row, "displacement_m").value();
      }
      std::vector<MeasuredSwimmer> swimmers;
      for (const auto &[overrides, displacement_m] : found)
        swimmers.push_back({read_scene(datasets / "scenes" / scene, overrides), displacement_m});
      return swimmers;
    }

    /// What bench/inertia measured.
    std::vector<MeasuredSwimmer> measured_in_plane()
    {
      return measured("inertia.csv", "reference-2d-paper.toml", keys_in_plane);
    }

    /// What bench/three-dimensions/inertia measured.
    std::vector<MeasuredSwimmer> measured_in_space()
    {
      auto keys = keys_in_plane;
      keys.push_back({"young_modulus_Pa", "tail.young_modulus_Pa"});
      keys.push_back({"steps_per_period", "time.steps_per_period"});
      return measured("inertia-3d.csv", "reference-3d-paper.toml", keys);
    }

    /// An estimate may be too large, up to twice: it costs a few per cent of the time. Too small it would cost the
    /// result.
    void expect_shares_of(const MeasuredSwimmer &swimmer)
    {
      const InertiaShares shares = inertia_shares(swimmer.scene);
      const double        lost   = swimmer.lost("none");
      EXPECT_GE(shares.together(), lost) << swimmer.scene.text;
      EXPECT_LE(shares.together(), 2. * lost) << swimmer.scene.text;
      const bool by_term = swimmer.displacement_m.contains("body");
      EXPECT_GE(shares.fluid, by_term ? swimmer.lost("body") : 0.) << swimmer.scene.text;
      EXPECT_GE((InertiaShares{0., shares.tail, shares.head}.together()), by_term ? swimmer.lost("fluid") : 0.)
          << swimmer.scene.text;
    }
  } // namespace

  TEST(InertiaShares, AreAtLeastWhatRunsWithoutTheTermsLose)
  {
    const auto in_plane = measured_in_plane(), in_space = measured_in_space();
    ASSERT_EQ(in_plane.size(), 36u);
    ASSERT_EQ(in_space.size(), 11u);
    for (const auto &swimmers : {in_plane, in_space})
      for (const auto &swimmer : swimmers)
        expect_shares_of(swimmer);
  }

  // Displacements with the fluid's terms over those without, as simulate gave them with these settings.
  TEST(InertiaShares, GrowWithHowFarTheFluidReaches)
  {
    struct Measured
    {
      const char *scene, *domain;
      double      frequency_Hz, gain;
    };
    for (const auto &[scene, domain, frequency_Hz, gain] :
         {Measured{"reference-2d-casefile", "domain.size_m=[40e-3,20e-3]", .9, 1.01906},
          Measured{"reference-2d-casefile", "domain.size_m=[80e-3,40e-3]", .9, 1.06258},
          Measured{"reference-2d-casefile", "domain.size_m=[160e-3,80e-3]", .9, 1.12131},
          Measured{"open-2d", "domain.radius_m=12e-3", .9, 1.06061},
          Measured{"open-2d", "domain.radius_m=50e-3", .9, 1.19813},
          Measured{"open-2d", "domain.radius_m=40e-3", .3, 1.18441},
          Measured{"open-2d", "domain.radius_m=40e-3", 2.7, 1.16415}})
    {
      const Scene swimmer =
          read_scene(datasets / "scenes" / (std::string(scene) + ".toml"),
                     {domain, "tail.young_modulus_Pa=8e4", "field.frequency_Hz=" + std::to_string(frequency_Hz)});
      const double share = inertia_shares(swimmer).fluid;
      EXPECT_GE(share / (1. - share), gain - 1.) << domain;
      EXPECT_LE(share / (1. - share), 2. * (gain - 1.)) << domain;
    }
  }

  TEST(InertiaTermsOfAuto, KeepAllThatMattersInEveryMeasuredRow)
  {
    for (const auto &swimmer : measured_in_plane())
      EXPECT_EQ(inertia_terms(swimmer.scene), all_inertia);
  }

  // Forty times the viscosity of glycerol and a tail so soft that it does not matter either: each term by itself.
  TEST(InertiaTermsOfAuto, LeaveOutWhatDoesNot)
  {
    const std::vector<std::string> thick{"fluid.viscosity_Pa_s=60.0"};
    EXPECT_FALSE(inertia_terms(reference(thick)).any());
    std::vector<std::string> heavy = thick;
    heavy.insert(heavy.end(), {"head.density_kg_m3=7e6"});
    EXPECT_EQ(inertia_terms(reference(heavy)), (InertiaTerms{.head = true}));
  }

  TEST(InertiaTermsOfAuto, LeaveOutNothingOfABodyThatComesToRest)
  {
    const Scene steady = read_scene(datasets / "scenes/fsi1.toml", {"fluid.inertia=auto"});
    ASSERT_TRUE(steady.time.is_steady);
    EXPECT_GT(inertia_shares(steady).tail, negligible_share);
    EXPECT_FALSE(inertia_terms(steady).tail);
    EXPECT_EQ(inertia_warning(steady), "");
  }

  TEST(InertiaTermsOfAuto, NeedsACouplingThatCarriesThem)
  {
    const Scene scene = reference({"numerics.coupling=fixed-point"});
    EXPECT_FALSE(inertia_terms(scene).any());
    EXPECT_GT(neglected_share(scene), negligible_share);
    EXPECT_NE(inertia_warning(scene), "");
    EXPECT_EQ(inertia_warning(reference({"fluid.inertia=none"})), "");
  }

  TEST(InertiaTermsOfAList, AreThoseThatItNames)
  {
    EXPECT_EQ(inertia_terms(reference({"fluid.inertia=[\"convective\", \"head\"]"})),
              (InertiaTerms{.convective = true, .head = true}));
    EXPECT_FALSE(inertia_terms(reference({"fluid.inertia=full", "head.motion=fixed"})).head);
  }

  TEST(HeadMoment, IsThatOfItsShape)
  {
    Head head;
    head.size_m = {2., 4.};
    EXPECT_DOUBLE_EQ(head.second_moment(2), 8. * (4. + 16.) / 12.);
    head.shape  = HeadShape::disc;
    head.size_m = {2., 2.};
    EXPECT_DOUBLE_EQ(head.second_moment(2), 0.5 * head.area_m2()); // A r^2 / 2
  }
} // namespace swimtwin
