#include <datasets/observation/track_observation.h>
#include <datasets/system/error.h>
#include <datasets/tracks/track_periods.h>
#include <tests/datasets/example_observations.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    /// A head that advances by `step_m` per period towards -x while it swings along both axes.
    HeadTrack swimming(const double frames_per_period, const double n_periods, const double step_m = 2e-4,
                       const double start_s = 0.)
    {
      HeadTrack    track{0.5, start_s, {}, {}, {}, {}, "track.csv:2"};
      const double step_s = 2. / frames_per_period;
      for (int i = 0; i * step_s <= 2. * n_periods * (1. + 1e-12); ++i)
      {
        const double phase = 2. * pi * 0.5 * (i * step_s - start_s);
        track.time_s.push_back(i * step_s);
        track.x_m.push_back(1e-3 - step_m * phase / (2. * pi) + 3e-5 * std::cos(2. * phase + 1.));
        track.y_m.push_back(1e-4 * std::sin(phase + 0.3));
      }
      return track;
    }

    double error_of_periods(const double frames_per_period)
    {
      const TrackPeriods periods = displacement_of_periods(swimming(frames_per_period, 4., 2e-4, 0.037), {-1., 0.});
      double             worst   = 0.;
      for (const double along : periods.along_m)
        worst = std::max(worst, std::abs(along - 2e-4));
      return worst;
    }

    ObservationSidecar sidecar_with(const Camera &camera, const std::optional<int> period = std::nullopt)
    {
      ObservationSidecar sidecar;
      sidecar.camera = camera;
      sidecar.period = period;
      return sidecar;
    }

    Camera facing_left()
    {
      Camera camera;
      camera.head_first = {{-1., 0.}};
      return camera;
    }

    std::string first_problem(const HeadTrack &track, const ObservationSidecar &sidecar)
    {
      DataProblems problems;
      observe_track(track, sidecar, problems);
      return problems.all().empty() ? "" : problems.all().front().text;
    }

    const std::string track_sidecar =
        replaced(example_sidecar, "period = 3", "period = \"periodic\"") + "[camera]\nhead_first = [-1, 0]\n";

    std::string track_csv(const HeadTrack &track, const bool with_frequency)
    {
      std::string text;
      for (std::size_t i = 0; i < track.time_s.size(); ++i)
        text += fmt::format("{:.17g},{:.17g},{:.17g}{}\n", track.time_s[i], track.x_m[i], track.y_m[i],
                            with_frequency ? fmt::format(",{}", track.frequency_Hz) : "");
      return text;
    }
  } // namespace

  TEST(TrackPeriods, FindTheStepOfEveryWholePeriod)
  {
    const TrackPeriods periods = displacement_of_periods(swimming(50., 4.3), {-2., 0.});
    EXPECT_EQ(periods.number, (std::vector<int>{1, 2, 3, 4}));
    EXPECT_NEAR(periods.frames_per_period, 50., 1e-9);
    for (const double along : periods.along_m)
      EXPECT_NEAR(along, 2e-4, 1e-12); // frames at the ends of periods
    for (const double across : periods.across_m)
      EXPECT_NEAR(across, 0., 1e-12);
  }

  TEST(TrackPeriods, CutPeriodsAreLeftOut)
  {
    EXPECT_EQ(displacement_of_periods(swimming(50., 4., 2e-4, 0.5), {-1., 0.}).number, (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(displacement_of_periods(swimming(50., 4., 2e-4, -0.5), {-1., 0.}).number, (std::vector<int>{2, 3, 4}));
  }

  TEST(TrackPeriods, EndsOfPeriodsAreOffByNoMoreThanACubicIs)
  {
    // Lagrange's remainder at both ends: |(t - t1) ... (t - t4)| <= h^4 among four frames, times x'''' / 24.
    const double fourth_derivative = 3e-5 * std::pow(2. * pi, 4);
    for (const double frames : {12.1, 17.3, 34.6, 69.2})
      EXPECT_LT(error_of_periods(frames), 2. * std::pow(2. / frames, 4) * fourth_derivative / 24.) << frames;
  }

  TEST(TrackPeriods, SidewaysIsPositiveToTheLeft)
  {
    HeadTrack track = swimming(50., 2.);
    for (std::size_t i = 0; i < track.y_m.size(); ++i)
      track.y_m[i] = -1e-5 * track.time_s[i]; // towards -x, -y is on the left
    EXPECT_NEAR(displacement_of_periods(track, {-1., 0.}).across_m[0], 2e-5, 1e-12);
  }

  TEST(TrackPeriods, AreNotTakenAcrossMissingFrames)
  {
    HeadTrack track = swimming(50., 4.);
    for (std::vector<double> *values : {&track.time_s, &track.x_m, &track.y_m})
      values->erase(values->begin() + 99, values->begin() + 102); // around the end of period 2
    const TrackPeriods periods = displacement_of_periods(track, {-1., 0.});
    EXPECT_EQ(periods.number, (std::vector<int>{1, 4}));
    EXPECT_EQ(periods.n_lost_to_gaps, 2);
  }

  TEST(TrackPeriods, HeadLeadsOppositeToTheMeanAngle)
  {
    HeadTrack track = swimming(50., 2.);
    for (const double time : track.time_s)
      track.angle_rad.push_back(0.4 + 0.3 * std::sin(pi * time));
    const auto direction = initial_head_first(track);
    ASSERT_TRUE(direction);
    EXPECT_NEAR((*direction)[0], -std::cos(0.4), 1e-9);
    EXPECT_NEAR((*direction)[1], -std::sin(0.4), 1e-9);
    EXPECT_FALSE(initial_head_first(swimming(50., 2.)));
  }

  TEST(TrackObservation, IsTheMeanWithItsStandardError)
  {
    HeadTrack track = swimming(50., 4.);
    for (std::size_t i = 0; i < track.x_m.size(); ++i) // periods of 2.1, 1.9, 2.1, 1.9 e-4 m
      track.x_m[i] -= 5e-6 * (1. - std::cos(pi * track.time_s[i] / 2.));
    DataProblems problems;
    const auto   point = observe_track(track, sidecar_with(facing_left()), problems);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->n_periods, 4);
    EXPECT_NEAR(point->displacement_m, 2e-4, 1e-12);
    EXPECT_NEAR(point->scatter_m, 1e-5 * std::sqrt(4. / 3.), 1e-11);
    EXPECT_NEAR(point->sigma_m, point->scatter_m / 2., 1e-15);
  }

  TEST(TrackObservation, NoiseOfPlacesCountsAtLeast)
  {
    Camera camera           = facing_left();
    camera.position_sigma_m = 2e-6;
    DataProblems problems;
    EXPECT_NEAR(observe_track(swimming(50., 4.), sidecar_with(camera), problems)->sigma_m, std::sqrt(2.) * 2e-6 / 4.,
                1e-12);
    EXPECT_NEAR(observe_track(swimming(50., 4.), sidecar_with(camera, 3), problems)->sigma_m, std::sqrt(2.) * 2e-6,
                1e-12);
    expect_in(first_problem(swimming(50., 4.), sidecar_with(facing_left(), 3)),
              "gives no error bar from 1 period(s); give");
  }

  TEST(TrackObservation, SkipsTheStart)
  {
    Camera camera           = facing_left();
    camera.skipped_periods  = 3;
    camera.position_sigma_m = 1e-6;
    DataProblems problems;
    EXPECT_EQ(observe_track(swimming(50., 5.), sidecar_with(camera), problems)->n_periods, 2);
    camera.skipped_periods = 7;
    expect_in(first_problem(swimming(50., 5.), sidecar_with(camera)),
              "track.csv:2: the track at 0.5 Hz has whole periods 1 to 5 and skipped_periods = 7; nothing is left");
  }

  TEST(TrackObservation, RefusesWhatItCannotAnswer)
  {
    expect_in(first_problem(swimming(50., 2.), sidecar_with(facing_left(), 3)),
              "has whole periods 1 to 2, not period 3; film");
    expect_in(first_problem(swimming(50., 0.7), sidecar_with(facing_left(), 1)), "has no whole period, not period 1");
    expect_in(first_problem(swimming(50., 4.), sidecar_with(Camera())),
              "has no angles; give the direction of the head");
    expect_in(first_problem(swimming(3.5, 40.), sidecar_with(facing_left())),
              "has 3.5 frames per period; at least 4 are needed");
  }

  TEST(TrackObservation, WarnsOfFewFramesFewPeriodsAndATurnedWay)
  {
    Camera camera           = facing_left();
    camera.position_sigma_m = 1e-6;
    expect_in(first_problem(swimming(8., 6.), sidecar_with(camera)), "has 8.0 frames per period; with fewer than 10");
    expect_in(first_problem(swimming(50., 3.), sidecar_with(camera)),
              "the mean is over 3 periods, and its standard error "
              "itself uncertain by 50 %; film at least 5.");
    camera.head_first = {{-1., 0.5}};
    expect_in(first_problem(swimming(50., 6.), sidecar_with(camera)),
              "the way made points 27 degrees away from head_first");
  }

  TEST(TrackFile, HoldsOneTrackPerFrequency)
  {
    HeadTrack slow = swimming(50., 6.), fast = swimming(50., 6., 1e-4);
    for (double &time : fast.time_s)
      time /= 2.;
    fast.frequency_Hz = 1.;
    const ObservationFiles files("time_s,x_m,y_m,frequency_Hz\n" + track_csv(fast, true) + track_csv(slow, true),
                                 track_sidecar + "position_sigma_m = 1e-6\n");
    const ObservationSet   set = read_observations(files.file);
    EXPECT_EQ(set.quantity, ObservedQuantity::positions);
    ASSERT_EQ(set.points.size(), 2u);
    EXPECT_EQ(set.points[0].frequency_Hz, 0.5);
    EXPECT_NEAR(set.points[0].displacement_m, 2e-4, 1e-11);
    EXPECT_NEAR(set.points[1].displacement_m, 1e-4, 1e-11);
    EXPECT_EQ(set.points[1].n_periods, 6);
  }

  TEST(TrackFile, MayBeOneOfSeveral)
  {
    ObservationFiles files("", track_sidecar +
                                   "position_sigma_m = 1e-6\n[[recording]]\nfile = \"slow.csv\"\nfrequency_Hz = "
                                   "0.5\n[[recording]]\nfile = \"late.csv\"\nfrequency_Hz = 0.6\n"
                                   "period_start_s = 4\n");
    files.folder.write("slow.csv", "time_s,x_m,y_m\n" + track_csv(swimming(50., 6.), false));
    files.folder.write("late.csv", "time_s,x_m,y_m\n" + track_csv(swimming(50., 6.), false));
    const ObservationSet set = read_observations(files.sidecar);
    EXPECT_EQ(set.points[0].n_periods, 6);
    EXPECT_EQ(set.points[1].n_periods, 4); // 8 s at 0.6 Hz
  }

  TEST(TrackFile, ListsItsProblems)
  {
    const auto message = [](const std::string &csv) { return ObservationFiles(csv, track_sidecar).message(); };
    expect_in(message("time_s,x_m,y_m\n0,0,0\n1,0,0\n"),
              "the column frequency_Hz is missing; add it (give the frequency");
    expect_in(message("time_s,x_m,frequency_Hz\n0,0,1\n"), "the column y_m is missing; add it (m)");
    const std::string header = "time_s,x_m,y_m,frequency_Hz\n";
    expect_in(message(header + "0,0,0,1\n1,0,0,1\n0.5,0,0,1\n1,0,0,1\n2,nan,0,1\n"),
              "data.csv:6: x_m (column 2) = \"nan\" is not a finite number");
    const std::string unordered = message(header + "0,0,0,1\n1,0,0,1\n0.5,0,0,1\n1,0,0,1\n");
    expect_in(unordered,
              "data.csv:4: time_s (column 1) = \"0.5\" does not come after 1 s (2 rows: lines 4, 5); sort the "
              "rows by time");
    expect_in(message(header + "0,0,0,1\n1,0,0,1\n"), "2 rows at 1 Hz are not a track; at least 4 are needed");
    expect_in(message(header), "there are no rows; a track needs a row per frame");
  }

  TEST(TrackFile, RecordingsListTheirProblems)
  {
    const auto message = [](const std::string &entries) {
      return ObservationFiles("", track_sidecar + entries).message();
    };
    expect_in(message("[[recording]]\nfile = \"none.csv\"\nfrequency_Hz = 0.5\n"), "cannot read the table");
    expect_in(message("[[recording]]\nfile = \"none.csv\"\n"),
              "data.toml:12: [recording.0] frequency_Hz is missing; add it");
    expect_in(message("[recording]\nfile = \"none.csv\"\n"), "must be tables: write [[recording]] above each.");
    expect_in(message("[[recording]]\nfil = \"none.csv\"\n"),
              "[recording.0] fil is not a known entry; the nearest known");
    expect_in(message("head_first = [0, 0]\n"), "redefin");
    expect_in(ObservationFiles("", replaced(track_sidecar, "[-1, 0]", "[0, 0]")).message(),
              "head_first = [0, 0] has no direction");
  }

  TEST(TrackFile, RecordingOverridesAColumnOfFrequenciesAndSaysSo)
  {
    const TemporaryFolder folder;
    const auto      file = folder.write("a.csv", "time_s,x_m,y_m,frequency_Hz\n" + track_csv(swimming(50., 6.), true));
    DataProblems    problems;
    const Recording recording{file, 0.7, 0., {}, ""};
    const auto      tracks = head_tracks(CsvTable::read(file), &recording, 0., problems);
    EXPECT_EQ(tracks.at(0).frequency_Hz, 0.7);
    expect_in(problems.all().at(0).text, "the column frequency_Hz is not used; the [[recording]] says 0.7 Hz");
  }

  TEST(TrackFile, TwoFilmsOfOneFrequencyAreReplicatesAndOneFilmTwiceIsNot)
  {
    const std::string one          = "[[recording]]\nfile = \"a.csv\"\nfrequency_Hz = 0.5\n";
    const auto        message_with = [&](const std::string &other) {
      ObservationFiles files("", track_sidecar + "position_sigma_m = 1e-6\n" + one + other);
      for (const char *name : {"a.csv", "b.csv"})
        files.folder.write(name, "time_s,x_m,y_m\n" + track_csv(swimming(50., 6.), false));
      const auto problems = lint_observations(files.sidecar);
      return problems.empty() ? "" : problems.front().text;
    };
    EXPECT_EQ(message_with("[[recording]]\nfile = \"b.csv\"\nfrequency_Hz = 0.5\n"), "");
    EXPECT_EQ(message_with(one + "period_start_s = 2\n"), "");
    expect_in(message_with(one), "at frequency 0.5 Hz stands already in");
    expect_in(message_with("[[recording]]\nfile = \"./a.csv\"\nfrequency_Hz = 1\n"),
              "at frequency 1 Hz stands already in");
  }

  TEST(TrackFile, ConvertsOtherUnits)
  {
    const TemporaryFolder folder;
    const auto            file =
        folder.write("a.csv", "time_ms;x_um;y (mm);angle_deg\n0;1;2;90\n500;2;2;90\n1000;3;2;90\n1500;4;2;90\n");
    DataProblems    problems;
    const Recording recording{file, 0.7, 0., {}, ""};
    const auto      tracks = head_tracks(CsvTable::read(file), &recording, 0., problems);
    EXPECT_DOUBLE_EQ(tracks.at(0).time_s[1], 0.5);
    EXPECT_DOUBLE_EQ(tracks[0].x_m[1], 2e-6);
    EXPECT_DOUBLE_EQ(tracks[0].y_m[1], 2e-3);
    EXPECT_DOUBLE_EQ(tracks[0].angle_rad[1], pi / 2.);
  }
} // namespace swimtwin
