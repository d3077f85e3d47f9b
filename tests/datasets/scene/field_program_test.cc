#include <datasets/scene/field_program.h>
#include <datasets/scene/field_program_writer.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    const std::string ramp_csv = "time_s,bx_T,by_T\n0,1,0\n0.5,2,1\n1.0,3,0\n1.5,2,-1\n";

    std::string message_for(const std::string &csv, const double period_s)
    {
      const TemporaryFolder folder;
      const auto            file    = folder.write("field.csv", csv);
      std::string           message = message_of<InputError>([&] { FieldProgram::read_csv(file, period_s); });
      expect_in(message, file.string() + ":");
      return message.substr(message.find("field.csv"));
    }
  } // namespace

  TEST(FieldProgram, IsZeroByDefault)
  {
    const FieldProgram field;
    EXPECT_EQ(field(0.3), (std::array<double, 3>{0., 0., 0.}));
    EXPECT_EQ(field.period_s(), 0.);
    EXPECT_EQ(field.waveform(), FieldProgram::Waveform::none);
  }

  TEST(FieldProgram, ConstantHasNoPeriod)
  {
    const FieldProgram field = FieldProgram::constant(1e-3, -2e-3);
    EXPECT_EQ(field(7.), (std::array<double, 3>{1e-3, -2e-3, 0.}));
    EXPECT_EQ(field.period_s(), 0.);
  }

  TEST(FieldProgram, SinusoidalIsTheReferenceField)
  {
    const FieldProgram field = FieldProgram::sinusoidal(5e-3, 4e-3, 0.8);
    EXPECT_DOUBLE_EQ(field.period_s(), 1.25);
    for (const double t : {0., 0.1, 0.7, 3.3})
    {
      EXPECT_DOUBLE_EQ(field(t)[0], 5e-3);
      EXPECT_NEAR(field(t)[1], 4e-3 * std::sin(2. * std::numbers::pi * 0.8 * t), 1e-17);
      EXPECT_NEAR(field(t + 1.25)[1], field(t)[1], 1e-16);
    }
  }

  TEST(FieldProgram, ComponentAlongZHasItsPhase)
  {
    const FieldProgram cone = FieldProgram::sinusoidal(1e-3, 4e-3, 0.5, {4e-3, std::numbers::pi / 2.});
    for (const double t : {0., 0.1, 0.7, 3.3}) // it turns about x
    {
      EXPECT_NEAR(cone(t)[2], 4e-3 * std::cos(std::numbers::pi * t), 1e-17);
      EXPECT_NEAR(std::hypot(cone(t)[1], cone(t)[2]), 4e-3, 1e-17);
    }
    EXPECT_EQ(FieldProgram::constant(1., 2., 3.)(7.), (std::array<double, 3>{1., 2., 3.}));
  }

  TEST(FieldProgram, LeavesThePlaneWhereverItIsAlongZ)
  {
    std::vector<std::array<double, 3>> b(4, {1e-3, 1e-3, 0.});
    const auto                         sampled = [&] { return FieldProgram::sampled({0., .1, .2, .3}, b, .4); };
    EXPECT_FALSE(FieldProgram().leaves_plane());
    EXPECT_FALSE(FieldProgram::sinusoidal(1e-3, 1e-3, 1., {0., 1.}).leaves_plane());
    EXPECT_FALSE(sampled().leaves_plane());
    b[2][2] = -1e-5;
    EXPECT_TRUE(sampled().leaves_plane());
    EXPECT_TRUE(FieldProgram::sinusoidal(1e-3, 1e-3, 1., {1e-5, 0.}).leaves_plane());
    EXPECT_TRUE(FieldProgram::constant(1e-3, 1e-3, 1e-5).leaves_plane());
  }

  TEST(FieldProgram, SinusoidalNeedsAPositiveFrequency)
  {
    expect_in(message_of<InputError>([] { FieldProgram::sinusoidal(1., 1., 0.); }), "frequency_Hz = 0");
    EXPECT_THROW(FieldProgram::sinusoidal(1., 1., std::nan("")), InputError);
  }

  TEST(FieldProgram, RampGrowsLinearly)
  {
    FieldProgram field = FieldProgram::constant(2., 4.);
    field.ramp_s       = 2.;
    EXPECT_EQ(field(-1.)[0], 0.);
    EXPECT_EQ(field(0.)[0], 0.);
    EXPECT_DOUBLE_EQ(field(0.5)[0], 0.5);
    EXPECT_DOUBLE_EQ(field(2.)[1], 4.);
    EXPECT_DOUBLE_EQ(field(3.)[1], 4.);
  }

  TEST(FieldProgram, SamplesAreJoinedByStraightLinesAndRepeat)
  {
    const TemporaryFolder folder;
    const FieldProgram    field = FieldProgram::read_csv(folder.write("field.csv", ramp_csv), 2.);
    EXPECT_EQ(field.waveform(), FieldProgram::Waveform::sampled);
    EXPECT_DOUBLE_EQ(field.period_s(), 2.);
    EXPECT_DOUBLE_EQ(field(0.)[0], 1.);
    EXPECT_DOUBLE_EQ(field(0.25)[0], 1.5);
    EXPECT_DOUBLE_EQ(field(0.25)[1], 0.5);
    EXPECT_DOUBLE_EQ(field(1.75)[0], 1.5); // between the last sample and the first of the next period
    EXPECT_DOUBLE_EQ(field(1.75)[1], -0.5);
    for (const double t : {0.1, 0.6, 1.2, 1.9})
      for (const int k : {-2, 1, 5})
        EXPECT_NEAR(field(t + 2. * k)[1], field(t)[1], 1e-14);
  }

  TEST(FieldProgram, TakesThePeriodFromTheFileBesideIt)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("ramp.csv", ramp_csv);
    folder.write("ramp.json", "{\"period_s\": 2}");
    EXPECT_EQ(FieldProgram::read_csv(file).period_s(), 2.);
    EXPECT_EQ(FieldProgram::read_csv(file, 1.9).period_s(), 1.9); // what is said here goes before
  }

  TEST(FieldProgram, RefusesAFileBesideItWithoutThePeriodOfThisTable)
  {
    const TemporaryFolder folder;
    const auto            file    = folder.write("ramp.csv", ramp_csv);
    const auto            message = [&](const std::string &text) {
      folder.write("ramp.json", text);
      return message_of<InputError>([&] { FieldProgram::read_csv(file); });
    };
    for (const std::string text : {"[1]", "{}", "{\"period_s\": \"2 s\"}", "{\"period_s\": -2}", "period_s = 2"})
      expect_in(message(text), "ramp.json: a positive number period_s, the period of ramp.csv in s, is missing");
    expect_in(message(""), "ramp.json: the file is empty");
    expect_in(message("{\"period_s\": 2, \"table_sha256\": \"0\"}"), "another table than");
  }

  TEST(FieldProgram, IsReadBackAsItWasWritten)
  {
    const TemporaryFolder                    folder;
    const std::vector<std::array<double, 3>> b{{0.3, 0., 0.}, {1. / 3., -1e-7, 0.}, {2., 0., 0.}, {1., 0., 0.}};
    for (const double bz : {0., 1e-3})
    {
      auto with_bz       = b;
      with_bz[2][2]      = bz;
      const auto written = FieldProgram::sampled({0., 0.1, 0.2, 0.30000000000000004}, with_bz, 0.4);
      write_field_program(folder.path / "field.csv", written, "from a test\nof two lines");
      const auto read = FieldProgram::read_csv(folder.path / "field.csv");
      EXPECT_EQ(read.time_s(), written.time_s());
      EXPECT_EQ(read.b_T(), written.b_T());
      EXPECT_EQ(read.period_s(), 0.4);
      EXPECT_EQ(content(folder.path / "field.csv").substr(0, 19),
                bz == 0. ? "time_s,bx_T,by_T\n0," : "time_s,bx_T,by_T,bz");
    }
  }

  TEST(FieldProgram, SamplesMayStartAfterTimeZero)
  {
    const std::vector<std::array<double, 3>> b{{0., 0., 0.}, {1., 0., 0.}, {2., 0., 0.}, {1., 0., 0.}};
    const FieldProgram                       field = FieldProgram::sampled({0.25, 0.75, 1.25, 1.75}, b, 2.);
    EXPECT_DOUBLE_EQ(field(0.)[0], 0.5);
    EXPECT_DOUBLE_EQ(field(0.1)[0], 0.3);
    EXPECT_DOUBLE_EQ(field(0.25)[0], 0.);
  }

  TEST(FieldProgram, ReadsTheThirdComponentAndWindowsLineEnds)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write(
                   "field.csv",
                   "\xEF\xBB\xBF# coils\r\ntime_s, bx_T, by_T, bz_T\r\n0,1,2,+3\r\n1,1,2,3\r\n\r\n2,1,2,3\r\n3,1,2,3e0\r\n");
    EXPECT_EQ(FieldProgram::read_csv(file, 4.)(2.5), (std::array<double, 3>{1., 2., 3.}));
  }

  TEST(FieldProgram, RefusesAMissingColumn)
  {
    expect_in(message_for("time_s,bx_T\n0,1\n", 1.), "field.csv:1: the column by_T is missing");
  }

  TEST(FieldProgram, RefusesWhatIsNotAFiniteNumber)
  {
    expect_in(message_for("time_s,bx_T,by_T\n0,1,1\n1,fast,1\n", 4.),
              "field.csv:3: bx_T = \"fast\" is not a finite number");
    expect_in(message_for("time_s,bx_T,by_T\n0,1,nan\n", 4.), "field.csv:2: by_T");
    expect_in(message_for("time_s,bx_T,by_T\n0,1,\n", 4.), "field.csv:2: by_T");
    expect_in(message_for("time_s,bx_T,by_T\n0,1 T,0\n", 4.), "field.csv:2: bx_T");
  }

  TEST(FieldProgram, SaysWhatARowOfUnitsContradicts)
  {
    expect_in(message_for("time_s,bx_T,by_T\ns,mT,mT\n0,1,0\n0.5,2,1\n1.0,3,0\n1.5,2,-1\n", 2.),
              "field.csv:2: time_s = \"s\" is not a finite number; this row says that bx_T is in mT: if so, name that "
              "column bx_mT, else correct the row; then leave the row out.");
    expect_in(message_for("time_s,bx_mT,by_mT\n0,1,0\n", 2.), "multiply bx_mT by 0.001 and name it bx_T.");
  }

  TEST(FieldProgram, RefusesARowOfAnotherLength)
  {
    expect_in(message_for("time_s,bx_T,by_T\n0,1,1\n1,1\n", 4.), "field.csv:3: this row has 2 values");
  }

  TEST(FieldProgram, RefusesAnEmptyFile)
  {
    expect_in(message_for("", 4.), "field.csv: the file is empty");
  }

  TEST(FieldProgram, RefusesTimesThatDoNotIncrease)
  {
    expect_in(message_for("time_s,bx_T,by_T\n0,1,1\n1,1,1\n1,1,1\n2,1,1\n", 4.),
              "field.csv:4: time_s = 1 does not increase");
    expect_in(message_for("time_s,bx_T,by_T\n-1,1,1\n1,1,1\n2,1,1\n3,1,1\n", 4.),
              "field.csv:2: time_s = -1 is negative");
  }

  TEST(FieldProgram, RefusesTooFewSamples)
  {
    expect_in(message_for("time_s,bx_T,by_T\n0,1,1\n1,1,1\n2,1,1\n", 3.), "3 samples are not enough; at least 4");
  }

  TEST(FieldProgram, RefusesASampleAtTheEndOfThePeriod)
  {
    expect_in(message_for(ramp_csv, 1.5), "field.csv:5: time_s = 1.5 is not before the end of the period (1.5 s)");
  }

  TEST(FieldProgram, RefusesAMissingPeriod)
  {
    expect_in(message_for(ramp_csv, 0.), "field.csv:1: the program has no period; give [field] period_s");
  }

  TEST(FieldProgram, RefusesGaps)
  {
    const std::string with_gap = "time_s,bx_T,by_T\n0,1,1\n1,1,1\n2,1,1\n4,1,1\n5,1,1\n";
    expect_in(message_for(with_gap, 6.), "field.csv:5: a gap of 2 s before this sample");
    expect_in(message_for(ramp_csv, 3.), "field.csv:5: a gap of 1.5 s between this last sample and the next period");
  }

  TEST(FieldProgram, AllowsStepsUpToOneAndAHalfMedians)
  {
    const TemporaryFolder folder;
    const auto file = folder.write("field.csv", "time_s,bx_T,by_T\n0,1,1\n1,1,1\n2.5,1,1\n3.5,1,1\n4.5,1,1\n");
    EXPECT_NO_THROW(FieldProgram::read_csv(file, 5.5));
  }

  TEST(FieldProgram, NamesAMissingFile)
  {
    const std::string message = message_of<InputError>([] { FieldProgram::read_csv("nowhere/field.csv", 1.); });
    expect_in(message, "nowhere/field.csv: No such file or directory");
  }
} // namespace swimtwin
