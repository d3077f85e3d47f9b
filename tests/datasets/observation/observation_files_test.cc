#include <datasets/system/error.h>
#include <tests/datasets/example_observations.h>

namespace swimtwin
{
  namespace
  {
    /// A curve that tells itself from others by its first displacement.
    std::string curve_of(const std::string &displacement)
    {
      return "frequency_Hz,displacement_m,sigma_m\n0.4," + displacement + ",3e-6\n0.8,1.8e-4,4e-6\n";
    }

    double first_displacement(const std::filesystem::path &file)
    {
      return read_observations(file).points.at(0).displacement_m;
    }

    std::string refusal_of_set(const std::filesystem::path &file)
    {
      return message_of<InputError>([&] { read_observations(file); });
    }
  } // namespace

  TEST(ObservationFile, IsTheOneThatWasNamed)
  {
    const ObservationFiles      files(curve_of("1e-4"));
    const std::filesystem::path txt = files.folder.write("data.txt", curve_of("2e-4"));
    const std::filesystem::path tsv = files.folder.write("data.TSV", curve_of("3e-4"));
    EXPECT_EQ(first_displacement(files.file), 1e-4);
    EXPECT_EQ(first_displacement(txt), 2e-4);
    EXPECT_EQ(first_displacement(tsv), 3e-4);
    EXPECT_EQ(read_observations(txt).file, txt);
    expect_in(refusal_of_set(files.folder.path / "data"), "cannot read the table");
    expect_in(refusal_of_set(files.folder.path / "none.csv"), "cannot read the observations");
    std::filesystem::remove(files.file);
    expect_in(refusal_of_set(files.file), "cannot read the table"); // though others lie beside
  }

  TEST(ObservationFile, OfASidecarIsTheOnlyOneBesideIt)
  {
    const ObservationFiles files(curve_of("1e-4"));
    files.folder.write("data.png", "no table");
    EXPECT_EQ(first_displacement(files.sidecar), 1e-4);
    files.folder.write("data.txt", curve_of("2e-4"));
    expect_in(refusal_of_set(files.sidecar),
              "data.csv, data.txt lie beside this sidecar; name the one to read with --data, or "
              "in the sidecar: table = \"data.csv\".");
    files.folder.write("data.toml", "table = \"data.txt\"\n" + example_sidecar);
    EXPECT_EQ(first_displacement(files.sidecar), 2e-4);
    expect_in(refusal_of_set(files.file),
              "belongs to another table, table = \"data.txt\"; name that one, or give this one a "
              "sidecar of its own, data.csv.toml.");
    files.folder.write("data.csv.toml", example_sidecar);
    EXPECT_EQ(first_displacement(files.file), 1e-4);
    EXPECT_EQ(first_displacement(files.folder.path / "data.csv.toml"), 1e-4);
    files.folder.write("other.toml", example_sidecar);
    expect_in(refusal_of_set(files.folder.path / "other.toml"),
              "no table lies beside this sidecar; put other.csv there");
  }

  TEST(ObservationFile, OfRecordingsIsNamedByItsSidecar)
  {
    const ObservationFiles files(example_curve,
                                 example_sidecar + "[[recording]]\nfile = \"a.csv\"\nfrequency_Hz = 1\n");
    expect_in(refusal_of_set(files.file),
              "reads a.csv ([[recording]]), not only this table; name the sidecar to read them.");
    files.folder.write("both.toml", "table = \"data.csv\"\n" + content(files.sidecar));
    expect_in(refusal_of_set(files.folder.path / "both.toml"),
              "and [[recording]] both say what to read; keep one of them");
  }

  TEST(ObservationFile, ThatCannotBeLookedAtIsNamed)
  {
    const TemporaryFolder folder;
    const auto            loop = folder.path / "loop", long_name = folder.path / (std::string(300, 'x') + ".csv");
    std::filesystem::create_symlink("loop", loop);
    for (const auto &named : {loop / "data.csv", loop / "data.toml", long_name})
      expect_in(message_of<InputError>([&] { read_observations(named); }),
                "cannot read the observations " + named.string() + ": ");
  }

  TEST(ObservationFile, IsNoFolder)
  {
    const ObservationFiles files(example_curve);
    std::filesystem::create_directory(files.folder.path / "data");
    const auto message = message_of<InputError>([&] { read_observations(files.folder.path / "data"); });
    expect_in(message, "/data: Is a directory; name a file in it.");
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }

  TEST(ObservationNames, TellSetsApart)
  {
    const TemporaryFolder              folder;
    std::vector<std::filesystem::path> files;
    for (const char *day : {"monday", "tuesday"})
    {
      std::filesystem::create_directories(folder.path / day / "a");
      files.push_back(folder.write(std::string(day) + "/run.csv", example_curve));
      folder.write(std::string(day) + "/run.toml", example_sidecar);
      files.push_back(folder.write(std::string(day) + "/a/x.csv", example_curve));
      folder.write(std::string(day) + "/a/x.toml", example_sidecar);
    }
    std::vector<ObservationSet> sets = read_observations(files);
    EXPECT_EQ(sets[0].name, "monday/run");
    EXPECT_EQ(sets[2].name, "tuesday/run");
    EXPECT_EQ(sets[1].name, "monday/a/x");
    sets = read_observations(std::vector{files[0], folder.write("monday/run.txt", example_curve)});
    EXPECT_EQ(sets[0].name, "run.csv");
    EXPECT_EQ(sets[1].name, "run.txt");
    EXPECT_EQ(read_observations(std::vector{files[0], files[1]})[0].name, "run");
  }

  TEST(ObservationNames, AFileCountsOnce)
  {
    const ObservationFiles files(example_curve);
    const auto             refusal = message_of<InputError>([&] {
      read_observations(std::vector{files.file, files.folder.path / "." / "data.toml"});
    });
    expect_in(refusal, "this file is named twice, and its measurements would count twice; name it once.");
  }

  TEST(ObservationSidecar, MayBeTextOfAnotherSystem)
  {
    ObservationFiles files(example_curve);
    std::string windows = "# \xB5m, Windows-1252\r\n" + replaced(example_sidecar, "period = 3\n", "period = 3\r\n");
    files.folder.write("data.toml", windows);
    EXPECT_EQ(read_observations(files.file).points.size(), 2u);
  }

  TEST(ObservationSidecar, DoesNotAdviseToRenameAnotherUnit)
  {
    const auto message = [](const std::string &entry) {
      return ObservationFiles(example_curve, entry + example_sidecar).message();
    };
    expect_in(message("body_length_mm = 8\n"),
              "body_length_mm is not a known entry; it is body_length_m in another unit: "
              "write body_length_m = 0.008.");
    expect_in(ObservationFiles(example_curve, example_sidecar + "[camera]\npixel_um = 5\n").message(),
              "pixel_um is not a known entry; it is pixel_m in another unit: write pixel_m = 5e-06.");
    expect_in(ObservationFiles(example_curve, example_sidecar + "[camera]\nlength_unit = \"furlong\"\n").message(),
              "length_unit = \"furlong\" is not a known unit of length");
  }
} // namespace swimtwin
