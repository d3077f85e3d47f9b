#include <datasets/observation/observation_set.h>
#include <datasets/system/error.h>
#include <tests/datasets/example_observations.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// What is said about a curve, with the good sidecar.
    std::string message_for_curve(const std::string &rows,
                                  const std::string &header = "frequency_Hz,displacement_m,sigma_m")
    {
      return ObservationFiles(header + "\n" + rows).message();
    }

    std::string message_for_sidecar(const std::string &what, const std::string &by)
    {
      return ObservationFiles(example_curve, replaced(example_sidecar, what, by)).message();
    }
  } // namespace

  TEST(ObservationSet, ReadsCurveAndSidecar)
  {
    const ObservationFiles files(example_curve);
    const ObservationSet   set = read_observations(files.file);
    EXPECT_EQ(set.name, "data");
    EXPECT_EQ(set.source, "made for a test");
    EXPECT_TRUE(set.synthetic);
    EXPECT_EQ(set.period, 3);
    ASSERT_EQ(set.points.size(), 2u);
    EXPECT_EQ(set.points[1].frequency_Hz, 0.8);
    EXPECT_EQ(set.points[1].displacement_m, 1.8e-4);
    EXPECT_EQ(set.points[1].sigma_m, 4e-6);
    expect_in(set.points[1].where, "data.csv:3");
    EXPECT_TRUE(set.warnings.empty());
    EXPECT_TRUE(lint_observations(files.file).empty());
  }

  TEST(ObservationSet, MayBeNamedByItsSidecar)
  {
    const ObservationFiles files(example_curve);
    EXPECT_EQ(read_observations(files.sidecar).points.size(), 2u);
  }

  TEST(ObservationSet, SortsPointsAndKeepsExtraColumnsWithThem)
  {
    const ObservationFiles files(
        "sigma_m,note,frequency_Hz,displacement_m\n1e-6,\"late, dim\",0.9,2e-4\n2e-6,b,0.3,1e-4\n");
    const ObservationSet set = read_observations(files.file);
    EXPECT_EQ(set.points[0].frequency_Hz, 0.3);
    EXPECT_EQ(set.points[0].sigma_m, 2e-6);
    EXPECT_EQ(set.extra_columns.at("note"), (std::vector<std::string>{"b", "late, dim"}));
    EXPECT_EQ(set.extra_columns.size(), 1u);
  }

  TEST(ObservationSet, MeanSpeedIsDisplacementTimesFrequency)
  {
    const ObservationFiles files("frequency_Hz,mean_speed_m_s,sigma_m_s\n0.5,1e-4,1e-6\n2,3e-4,2e-6\n");
    const ObservationSet   set = read_observations(files.file);
    EXPECT_EQ(set.quantity, ObservedQuantity::mean_speed);
    EXPECT_DOUBLE_EQ(set.points[0].displacement_m, 2e-4);
    EXPECT_DOUBLE_EQ(set.points[1].sigma_m, 1e-6);
  }

  TEST(ObservationSet, FieldIsPlayedAtTheFrequency)
  {
    const ObservationSet set = read_observations(ObservationFiles(example_curve).file);
    const FieldProgram   b   = field_at(set, 0.8);
    EXPECT_DOUBLE_EQ(b.period_s(), 1.25);
    EXPECT_NEAR(b(0.25 * 1.25)[1], 4e-3, 1e-15);
    EXPECT_EQ(b(0.)[0], 5e-3);
    expect_in(message_of<InputError>([&] { field_at(set, 0.); }), "frequency_Hz = 0");
  }

  TEST(ObservationSet, FieldProgramIsStretchedToTheFrequency)
  {
    const std::string field = "[field]\nprogram = \"field.csv\"\nperiod_s = 2\n";
    ObservationFiles  files(example_curve, example_sidecar.substr(0, example_sidecar.find("[field]")) + field);
    files.folder.write("field.csv", "time_s,bx_T,by_T\n0,1,0\n0.5,2,1\n1.0,3,0\n1.5,2,-1\n");
    const FieldProgram b = field_at(read_observations(files.file), 4.);
    EXPECT_DOUBLE_EQ(b.period_s(), 0.25);
    EXPECT_DOUBLE_EQ(b(0.0625)[1], 1.);
    EXPECT_DOUBLE_EQ(b(0.125)[0], 3.);
  }

  TEST(ObservationSet, PeriodicStateIsAWord)
  {
    const ObservationFiles files(example_curve, replaced(example_sidecar, "period = 3", "period = \"periodic\""));
    EXPECT_FALSE(read_observations(files.file).period.has_value());
    expect_in(message_for_sidecar("period = 3", "period = \"priodic\""), "the nearest is \"periodic\"");
    expect_in(message_for_sidecar("period = 3", "period = 0"), "period = 0 is out of range; it must be at least 1");
  }

  TEST(ObservationSet, ConvertsColumnsInOtherUnits)
  {
    const ObservationFiles files("Frequency (mHz);Displacement [\u00B5m];sigma_mm\n400;170;3e-3\n800;180;4e-3\n");
    const ObservationSet   set = read_observations(files.file);
    EXPECT_DOUBLE_EQ(set.points.at(1).frequency_Hz, 0.8);
    EXPECT_DOUBLE_EQ(set.points[1].displacement_m, 1.8e-4);
    EXPECT_DOUBLE_EQ(set.points[1].sigma_m, 4e-6);
    EXPECT_TRUE(set.extra_columns.empty());
    expect_in(files.warning(), "data.csv:1: units are converted: frequency_Hz = 0.001 times \"Frequency (mHz)\", ");
    const ObservationFiles speeds("frequency_rad_s,mean_speed_um_s,sigma_um_s\n3.14159265,100,1\n6.2831853,200,2\n");
    EXPECT_NEAR(read_observations(speeds.file).points.at(1).displacement_m, 2e-4, 1e-11);
    EXPECT_NEAR(read_observations(speeds.file).points.at(0).frequency_Hz, 0.5, 1e-8);
  }

  TEST(ObservationLint, RefusesAMissingColumn)
  {
    expect_in(
        message_for_curve("1,2,3\n2,3,4\n", "frequency_Hz,displacement,sigma_m"),
        "data.csv:1: the column displacement_m is missing; write the unit of \"displacement\" into its name, as in "
        "displacement_m; other units are converted.");
    expect_in(message_for_curve("1,2,3\n2,3,4\n", "frequency_Hz,displacement_px,sigma_m"),
              "\"displacement_px\" is in px, whose size is not known here: compute the numbers in m and name them "
              "displacement_m.");
    expect_in(message_for_curve("1,2,3\n2,3,4\n", "frequency_Hz,Displacement (?m),sigma_m"),
              "name \"Displacement (?m)\", where the sign for micro was damaged on the way, displacement_um, or save");
    expect_in(message_for_curve("1,2,3,4\n2,3,4,5\n", "frequency_Hz,displacement_mm,displacement_um,sigma_m"),
              "\"displacement_mm\" and \"displacement_um\" may both be it; keep one of them.");
    expect_in(message_for_curve("1,2,3\n2,3,4\n", "frequency_Hz,way,sigma_m"), "(nearest name: way)");
    expect_in(message_for_curve("0.8,1e-4,1e-6\n", "0.4,1e-4,1e-6"),
              "data.csv:1: the first row holds numbers; put a row of column names");
    expect_in(message_for_curve("frequency_Hz,displacement_m,sigma_m\n0.8,1e-4,1e-6\n", "run 3,,of May"),
              "data.csv:1: this row names no column, but line 2 does; delete the lines above that");
  }

  TEST(ObservationLint, LetsAColumnInAnotherUnitKeepIt)
  {
    const auto advice_for = [](const std::string &header) { return message_for_curve("1,2,3\n2,3,4\n", header); };
    expect_in(advice_for("frequency_Hz,disp_mm,sigma_m"), "the column displacement_m is missing; add it (m), or, if "
                                                          "\"disp_mm\" holds it, name that displacement_mm, which is "
                                                          "converted.");
    expect_in(advice_for("frequency_Hz,Displ. [mm],sigma_m"), "\"Displ. [mm]\" holds it, name that displacement_mm,");
    expect_in(advice_for("frequency_Hz,Verschiebung (\u00B5m),sigma_m"), "name that displacement_um,");
    expect_in(advice_for("frequency_Hz,displacement_m,std_um"), "if \"std_um\" holds it, name that sigma_um,");
    expect_in(advice_for("freq_mHz,displacement_m,sigma_m"), "if \"freq_mHz\" holds it, name that frequency_mHz,");
    expect_in(advice_for("t [ms],x_um,y_um"), "if \"t [ms]\" holds it, name that time_ms,");
    expect_in(advice_for("frequency_Hz,speed_mm_s,sigma_mm_s"),
              "if \"speed_mm_s\" holds it, name that mean_speed_mm_s,");
    expect_in(advice_for("frequency_Hz,way_m,sigma_m"), "if \"way_m\" holds it, name that displacement_m.");
    expect_in(advice_for("frequency_Hz,,sigma_m"), "the column displacement_m is missing; add it (m).");
    expect_in(advice_for("frequency_Hz,displacement_m,run_h"), "give one standard deviation");
  }

  TEST(ObservationLint, SaysInOneSentenceThatUnitsStandAboveTheNames)
  {
    const auto sentence = [](const std::string &header) {
      const std::string message = message_for_curve(header + "\n0.4,1,0.1\n0.8,2,0.1\n", "Hz,mm,mm");
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message;
    };
    expect_in(sentence("frequency_Hz,displacement_mm,sigma_mm"),
              "data.csv:1: this row names no column, but line 2 does");
    expect_in(sentence("frequency,displacement,sigma"),
              "data.csv:1: this row holds units, not names; write them into the names below it, as in frequency_Hz,");
  }

  TEST(ObservationLint, SaysWhatARowOfUnitsContradicts)
  {
    const std::string rows = "0.4,0.017,3e-4\n0.8,0.018,4e-4\n";
    for (const std::string &text : {"Hz,cm,cm\n" + rows, rows + "(Hz),(cm),(cm)\n"})
    {
      const std::string message = message_for_curve(text);
      expect_in(message, ": this row says that displacement_m is in cm: if so, name that column displacement_cm, else "
                         "correct the row; then leave the row out.");
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    EXPECT_EQ(message_for_curve("Hz,m,m\n" + rows).substr(message_for_curve("Hz,m,m\n" + rows).find(":2:")),
              ":2: this row holds units, which stand in the names of the columns: leave it out.");
    expect_in(message_for_curve("s,um,um\n0,1,2\n", "time_s,x_m,y_m"), "name that column x_um");
  }

  TEST(ObservationLint, RefusesWhatIsNotANumber)
  {
    expect_in(
        message_for_curve("0.4,nan,1e-6\n0.8,1e-4,1e-6\n"),
        "data.csv:2: displacement_m (column 2) = \"nan\" is not a finite number; correct it, or leave the row out.");
    expect_in(message_for_curve("0.4,1e-4,inf\n0.8,1e-4,1e-6\n"),
              "data.csv:2: sigma_m (column 3) = \"inf\" is not a finite");
    expect_in(message_for_curve("0.4,\"1,5e-4\",1e-6\n0.8,1e-4,1e-6\n"), "= \"1,5e-4\" is not a finite number");
    expect_in(message_for_curve("0.4,,1e-6\n0.8,1e-4,1e-6\n"), "= \"\" is not a finite number");
  }

  TEST(ObservationLint, RefusesErrorBarsThatAreNotPositive)
  {
    expect_in(message_for_curve("0.4,1e-4,0\n0.8,1e-4,1e-6\n"),
              "data.csv:2: sigma_m (column 3) = \"0\" is not positive; give "
              "one standard deviation of displacement_m");
    expect_in(message_for_curve("0.4,1e-4,1e-6\n0.8,1e-4,-1e-6\n"),
              "data.csv:3: sigma_m (column 3) = \"-1e-6\" is not positive");
    expect_in(message_for_curve("0,1e-4,1e-6\n0.8,1e-4,1e-6\n"), "frequency_Hz (column 1) = \"0\" is not positive");
  }

  // What plotting programs export: names, then a row of their units.
  TEST(ObservationSet, TakesUnitsFromTheRowBelowNamesWithoutAny)
  {
    for (const char *units : {"Hz,cm,mm", "[Hz],(cm),(mm)"})
    {
      const ObservationFiles files(std::string("frequency,displacement,sigma\n") + units +
                                   "\n0.4,0.017,3e-3\n0.8,0.018,4e-3\n");
      const ObservationSet   set = read_observations(files.file);
      ASSERT_EQ(set.points.size(), 2u);
      EXPECT_DOUBLE_EQ(set.points[0].displacement_m, 0.017e-2);
      EXPECT_DOUBLE_EQ(set.points[1].sigma_m, 4e-6);
      expect_in(set.warnings.front(), "units are converted");
    }
    expect_in(message_for_curve("Hz,furlong,mm\n0.4,1,0.1\n", "frequency,displacement,sigma"), "is missing");
  }

  TEST(ObservationSet, ReplicatesAreData)
  {
    const ObservationFiles files("frequency_Hz,displacement_m,sigma_m\n0.8,1e-4,1e-6\n0.4,2e-4,1e-6\n0.80,3e-4,1e-6\n");
    EXPECT_EQ(read_observations(files.file).points.size(), 3u);
    EXPECT_EQ(files.warning(), "");
    const ObservationFiles copied(
        "frequency_Hz,displacement_m,sigma_m\n0.8,1e-4,1e-6\n0.4,2e-4,1e-6\n0.80,1e-4,1e-6\n");
    expect_in(copied.warning(), "data.csv:4: frequency and value stand already on a line before; a copied row counts");
  }

  TEST(ObservationLint, RefusesASinglePoint)
  {
    expect_in(message_for_curve("0.8,1e-4,1e-6\n"), "1 point(s) are no curve; at least 2 are needed");
    expect_in(message_for_curve(""), "0 point(s) are no curve");
  }

  TEST(ObservationLint, RefusesTwinColumnsAndRaggedRows)
  {
    expect_in(message_for_curve("0.8,1e-4,1e-6,3\n0.9,1e-4,1e-6,3\n", "frequency_Hz,displacement_m,sigma_m,sigma_m"),
              "there are two columns sigma_m");
    expect_in(message_for_curve("0.8,1e-4\n0.9,1e-4,1e-6\n0.7,1e-4,1e-6\n"),
              "data.csv:2: this row has 2 values but the header names 3 columns; give one value per column.");
  }

  TEST(ObservationLint, SaysEverythingAtOnce)
  {
    const ObservationFiles files("frequency_Hz,displacement_m,sigma_m\n0.4,nan,-1\n0.8,1e-4\n0.9,1e-4,0\n",
                                 replaced(example_sidecar, "swimmer", "swimer"));
    const auto             problems = lint_observations(files.file);
    EXPECT_EQ(problems.size(), 5u); // unknown swimer, missing swimmer, ragged row, nan, sigma on two lines
    const std::string message = files.message();
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 4);
    for (const char *part :
         {"data.toml:3: swimer is not a known entry; the nearest known name is swimmer", "swimmer is missing",
          "data.csv:2: displacement_m",
          "data.csv:2: sigma_m (column 3) = \"-1\" is not positive (2 rows: lines 2, 4); give", "data.csv:3: this row"})
      expect_in(message, part);
  }

  TEST(ObservationLint, WarnsOfMillimetresInAColumnOfMetres)
  {
    const ObservationFiles files("frequency_Hz,displacement_m,sigma_m\n0.4,0.17,3e-3\n0.8,0.18,4e-3\n");
    expect_in(files.warning(), "data.csv:3: a displacement of 0.18 m per period is 18 body lengths of 0.01 m; it looks "
                               "like mm in a column of metres: check the unit.");
    EXPECT_EQ(lint_observations(files.file)[0].severity, Severity::warning);
    EXPECT_TRUE(implausible_sizes(read_observations(files.file), 0.1).empty());
  }

  TEST(ObservationLint, TakesTheBodyLengthOfTheSidecar)
  {
    const std::string curve = "frequency_Hz,displacement_m,sigma_m\n0.4,0.17,3e-3\n0.8,0.18,4e-3\n";
    EXPECT_EQ(ObservationFiles(curve, "body_length_m = 0.1\n" + example_sidecar).warning(), "");
    expect_in(message_for_sidecar("period = 3", "period = 3\nbody_length_m = 0"), "body_length_m = 0 is out of range");
  }

  TEST(ObservationLint, WarnsOfSizesNobodySees)
  {
    expect_in(ObservationFiles("frequency_Hz,displacement_m,sigma_m\n0.4,1e-10,3e-12\n0.8,2e-10,3e-12\n").warning(),
              "no displacement is larger than 2e-10 m per period");
    expect_in(ObservationFiles("frequency_Hz,displacement_m,sigma_m\n0.4,1e-4,3e-3\n0.8,2e-4,4e-3\n").warning(),
              "every error bar is as large as its displacement");
    expect_in(ObservationFiles("frequency_Hz,displacement_m,sigma_m\n0.4,1e-4,3e-12\n0.8,2e-4,4e-12\n").warning(),
              "every error bar is below 1e-05 of its displacement");
  }

  TEST(ObservationSidecar, IsRequired)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("lonely.csv", example_curve);
    expect_in(message_of<InputError>([&] { read_observations(file); }), "lonely.toml is missing; write it with source");
  }

  TEST(ObservationSidecar, NamesWhatIsMissingOrMisspelt)
  {
    expect_in(message_for_sidecar("synthetic = true\n", ""), "synthetic is missing; add it as true or false.");
    expect_in(message_for_sidecar("\"made for a test\"", "\"\""), "source = \"\" is empty; say it in a few words.");
    expect_in(message_for_sidecar("period = 3", "perid = 3"),
              "data.toml:5: perid is not a known entry; the nearest known "
              "name is period.");
    expect_in(message_for_sidecar("period = 3\n", ""), "period is missing; add it as a whole number.");
    expect_in(message_for_sidecar("by_T = 4e-3", "bz_T = 4e-3"), "[field] bz_T is not a known entry");
    expect_in(message_for_sidecar("[field]\nbx_T = 5e-3\nby_T = 4e-3\n", ""),
              "the table [field] is missing; add bx_T and");
    expect_in(message_for_sidecar("bx_T = 5e-3\nby_T = 4e-3", "bx_T = 0.0\nby_T = 0.0"),
              "without a field nothing swims");
    expect_in(message_for_sidecar("by_T = 4e-3", "by_T = 4e-3\nprogram = \"x.csv\"\nperiod_s = 1"),
              "contradicts the program; keep one of them");
    expect_in(message_for_sidecar("bx_T = 5e-3\nby_T = 4e-3", "program = \"x.csv\""), "period_s is missing");
    expect_in(message_for_sidecar("bx_T = 5e-3\nby_T = 4e-3", "program = \"x.csv\"\nperiod_s = 1"),
              "cannot read the table");
    expect_in(message_for_sidecar("period = 3", "period = = 3"), "data.toml:5:10: this is not valid TOML");
  }

  TEST(ObservationSidecar, OnlyComputedDataAreWithoutInertia)
  {
    EXPECT_TRUE(read_observations(ObservationFiles(example_curve).file).has_inertia);
    const std::string without = replaced(example_sidecar, "[field]", "[fluid]\ninertia = \"none\"\n[field]");
    EXPECT_FALSE(read_observations(ObservationFiles(example_curve, without).file).has_inertia);
    const std::string measured = replaced(without, "synthetic = true", "synthetic = false");
    expect_in(ObservationFiles(example_curve, measured).message(), "can be said of computed data only");
    const std::string odd = replaced(without, "inertia = \"none\"", "inertia = \"some\"");
    expect_in(ObservationFiles(example_curve, odd).message(), "inertia");
  }

  TEST(ObservationSidecar, OnlyComputedDataHaveADimension)
  {
    const std::string flat = replaced(example_sidecar, "period = 3", "dimension = 2\nperiod = 3");
    EXPECT_EQ(read_observations(ObservationFiles(example_curve, flat).file).dimension, 2);
    EXPECT_FALSE(read_observations(ObservationFiles(example_curve).file).dimension);
    expect_in(ObservationFiles(example_curve, replaced(flat, "dimension = 2", "dimension = 4")).message(), "be 2 or 3");
    expect_in(ObservationFiles(example_curve, replaced(flat, "synthetic = true", "synthetic = false")).message(),
              "dimension = 2 can be said of computed data only");
  }

  TEST(ObservationSidecar, WarnsOfAFieldThatLooksLikeMillitesla)
  {
    const auto warning = [](const std::string &field) {
      ObservationFiles files(example_curve, example_sidecar.substr(0, example_sidecar.find("bx_T")) + field);
      files.folder.write("field.csv", "time_s,bx_T,by_T\n0,5,0\n0.5,5,4\n1.0,5,0\n1.5,5,-4\n");
      return files.warning();
    };
    expect_in(warning("bx_T = 5\nby_T = 4\n"),
              "data.toml:7: the field reaches 6.403 T; it looks like mT in entries of T: check the unit.");
    expect_in(warning("program = \"field.csv\"\nperiod_s = 2\n"),
              "field.csv reaches 6.403 T; it looks like mT in columns of T: check the unit.");
    EXPECT_EQ(warning("bx_T = 0.5\nby_T = 0.4\n"), "");
  }

  TEST(ObservationSidecar, AsksForTheTemperatureOfMeasuredFluid)
  {
    const std::string measured = replaced(example_sidecar, "synthetic = true", "synthetic = false");
    expect_in(ObservationFiles(example_curve, measured).warning(), "[fluid] temperature_C is missing");
    const ObservationFiles files(example_curve, measured + "[fluid]\ntemperature_C = 19.5\n");
    EXPECT_EQ(files.warning(), "");
    EXPECT_EQ(read_observations(files.file).temperature_C, 19.5);
    expect_in(ObservationFiles(example_curve, measured + "[fluid]\ntemperature_C = 292\n").message(),
              "temperature_C = 292 is out of range; it must lie between -50 and 150 (unit: degrees Celsius).");
  }

  TEST(ObservationSidecar, WarnsOfACameraWithoutATrack)
  {
    expect_in(ObservationFiles(example_curve, example_sidecar + "[camera]\nframe_s = 0.04\n").warning(),
              "[camera] is not used");
  }
} // namespace swimtwin
