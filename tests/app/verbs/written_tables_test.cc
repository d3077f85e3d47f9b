#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <tests/app/tool_in_process.h>
#include <tests/control/small_model.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>
#include <tests/rom/example_model.h>

#include <fmt/format.h>

#include <cstdlib>

namespace swimtwin
{
  namespace
  {
    /// Every file is read by Python's csv.DictReader alone.
    class WrittenTables : public ::testing::Test
    {
    protected:
      void run(const std::vector<std::string> &arguments) const
      {
        const Outcome outcome = run_in_process(arguments, {{"sweep", add_sweep},
                                                           {"reconstruct", add_reconstruct},
                                                           {"calibrate", add_calibrate},
                                                           {"optimize", add_optimize},
                                                           {"track", add_track}});
        ASSERT_EQ(outcome.code, 0) << outcome.errors;
      }

      void expect_readable_tables(const std::size_t n_tables) const
      {
        const std::filesystem::path said = folder.path / "said";
        const std::string command        = fmt::format("'{}' -B '{}/check_tables.py' '{}' > '{}' 2>&1", places::python,
                                                       places::checks, results, said.string());
        EXPECT_EQ(std::system(command.c_str()), 0);
        EXPECT_EQ(content(said), fmt::format("{}\n", n_tables));
      }

      const TemporaryFolder folder;
      const std::string     results = folder.path / "results";
    };
  } // namespace

  TEST_F(WrittenTables, OfASweep)
  {
    write_reduced_model(folder.path / "model.h5", example_model({.magnetic_tail = false}), Provenance{});
    run({"sweep", folder.path / "model.h5", "--young-modulus", "1e4,1e5", "--quiet", "--output", results});
    expect_readable_tables(1);
  }

  TEST_F(WrittenTables, OfAReconstructedRun)
  {
    run({"reconstruct", "open-2d", "--quiet", "--output", results});
    expect_readable_tables(1);
  }

  TEST_F(WrittenTables, OfAFitToDataOfAnyName)
  {
    const std::string name = "#1, \"soft\"\nswimmer";
    folder.write("fit.toml", "[parameters.young_modulus_over_viscosity_1_s]\nbounds = [3.5e4, 8e4]\n"
                             "[parameters.magnetization_over_viscosity_A_m_Pa_s]\nbounds = [1e5, 1.7e5]\n"
                             "[fit]\nstarts = 6\n[uncertainty]\nbootstrap_samples = 40\n");
    folder.write(name + ".toml", "source = \"none\"\nsynthetic = true\nswimmer = \"none\"\nmeasured_by = \"none\"\n"
                                 "period = 3\n[field]\nbx_T = 5e-3\nby_T = 5e-3\n");
    const std::string table =
        folder.write(name + ".csv", "frequency_Hz,displacement_m,sigma_m\n0.2,1.14e-4,2e-6\n0.5,1.8e-4,3e-6\n"
                                    "1,1.7e-4,3e-6\n");
    run({"calibrate", "reference-2d", folder.path / "fit.toml", "--data", table, "--no-picture", "--quiet", "--output",
         results});
    expect_readable_tables(7);
    EXPECT_NO_THROW(parse_scene(content(folder.path / "results/fitted-scene.toml"), "fitted-scene.toml"));
  }

  TEST_F(WrittenTables, OfAPlannedField)
  {
    write_reduced_model(folder.path / "model.h5", small_model(), Provenance{});
    folder.write("goal.toml", "[objective]\nmean_speed = 1\n[field]\nharmonics = 2\nfamily = \"symmetric\"\n"
                              "frequency_low_Hz = 0.2\nfrequency_high_Hz = 1.5\nsample_rate_Hz = 200\n"
                              "[limits]\nmagnitude_T = 7e-3\n[search]\nstarts = 0\nmax_evaluations = 12\n");
    run({"optimize", folder.path / "model.h5", folder.path / "goal.toml", "--no-picture", "--quiet", "--output",
         results});
    expect_readable_tables(5);
  }

  TEST_F(WrittenTables, OfAPathAndATarget)
  {
    folder.write("path.toml", "kind = \"path\"\n[path]\nshape = \"line\"\nsize_m = 6e-4\n"
                              "[loop]\ndecisions_per_second = 5.0\nsample_rate_Hz = 50.0\n");
    folder.write("target.toml", "kind = \"target\"\n[target]\nposition_m = [8e-4, 1e-4]\ndistance = 0.02\n"
                                "sample_rate_Hz = 100.0\n");
    for (const std::string goal : {"path", "target"})
      run({"track", "open-2d", folder.path / (goal + ".toml"), "--inertia", "none", "--no-picture", "--quiet",
           "--output", results + "/" + goal});
    expect_readable_tables(4);
  }
} // namespace swimtwin
