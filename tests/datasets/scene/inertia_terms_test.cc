#include <datasets/text/csv_table.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
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

    /// Displacements (m) with some terms of inertia: what bench/inertia measured for one swimmer.
    struct MeasuredSwimmer
    {
      Scene                         scene;
      std::map<std::string, double> displacement_m;

      /// Share of the displacement that is lost by keeping these terms alone.
      double lost(const std::string &kept) const { return 1. - displacement_m.at(kept) / displacement_m.at("full"); }
    };

    std::vector<MeasuredSwimmer> measured_swimmers()
    {
      const CsvTable table = CsvTable::read(datasets / "reference/inertia.csv");
      const auto     M = table.column("magnetization_A_m"), mu = table.column("viscosity_Pa_s"),
                 f = table.column("frequency_Hz"), displacement = table.column("displacement_m");
      const auto                                                   terms = table.find_column("terms").value();
      std::map<std::vector<double>, std::map<std::string, double>> found;
      for (std::size_t i = 0; i < table.n_rows(); ++i)
        found[{M[i], mu[i], f[i]}][table.cells(i)[terms]] = displacement[i];
      std::vector<MeasuredSwimmer> swimmers;
      for (const auto &[at, measured] : found)
        swimmers.push_back({reference({"head.magnetization_A_m=" + std::to_string(at[0]),
                                       "fluid.viscosity_Pa_s=" + std::to_string(at[1]),
                                       "field.frequency_Hz=" + std::to_string(at[2])}),
                            measured});
      return swimmers;
    }
  } // namespace

  // An estimate may be too large, up to twice: it costs a few per cent of the time. Too small it would cost the result.
  TEST(InertiaShares, AreAtLeastWhatRunsWithoutTheTermsLose)
  {
    const auto swimmers = measured_swimmers();
    ASSERT_EQ(swimmers.size(), 36u);
    for (const auto &swimmer : swimmers)
    {
      const InertiaShares shares = inertia_shares(swimmer.scene);
      const double        lost   = swimmer.lost("none");
      EXPECT_GE(shares.together(), lost) << swimmer.scene.text;
      EXPECT_LE(shares.together(), 2. * lost) << swimmer.scene.text;
      EXPECT_GE(shares.fluid, swimmer.lost("body"));
      EXPECT_GE((InertiaShares{0., shares.tail, shares.head}.together()), swimmer.lost("fluid"));
    }
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
    for (const auto &swimmer : measured_swimmers())
      EXPECT_EQ(inertia_terms(swimmer.scene),
                (InertiaTerms{.unsteady = true, .convective = true, .tail = true, .head = true}));
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
