#include <datasets/data_problems.h>
#include <datasets/observation_curve.h>
#include <datasets/observation_set.h>
#include <datasets/observation_sidecar.h>
#include <datasets/track_observation.h>
#include <datasets/trackmate_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr double centimetre_m = 1e-2; // micro-robots are not longer

    std::filesystem::path with_extension(std::filesystem::path file, const char *extension)
    {
      return file.replace_extension(extension);
    }

    /// A table without its rows of wrong length, which are noted as errors.
    CsvTable read_table(const std::filesystem::path &file, DataProblems &problems)
    {
      std::vector<std::string> left_out;
      CsvTable                 table = CsvTable::read(file, left_out);
      for (const std::string &sentence : left_out)
        problems.error(sentence);
      return table;
    }

    void describe(const ObservationSidecar &sidecar, ObservationSet &set)
    {
      set.source        = sidecar.source;
      set.swimmer       = sidecar.swimmer;
      set.measured_by   = sidecar.measured_by;
      set.synthetic     = sidecar.synthetic;
      set.temperature_C = sidecar.temperature_C;
      set.body_length_m = sidecar.body_length_m;
      set.period        = sidecar.period;
      set.field         = sidecar.field;
    }

    void add_tracks(const std::vector<HeadTrack> &tracks, const ObservationSidecar &sidecar, ObservationSet &set,
                    DataProblems &problems)
    {
      set.quantity = ObservedQuantity::positions;
      for (const HeadTrack &track : tracks)
        if (const auto point = observe_track(track, sidecar, problems))
          set.points.push_back(*point);
    }

    void read_recording(const Recording &recording, const ObservationSidecar &sidecar, ObservationSet &set,
                        DataProblems &problems)
    {
      const CsvTable table = read_table(recording.file, problems);
      if (is_trackmate_table(table))
        add_tracks(trackmate_track(table, recording, *sidecar.camera, problems), sidecar, set, problems);
      else
        add_tracks(head_tracks(table, &recording, recording.period_start_s, problems), sidecar, set, problems);
    }

    void read_table_of_set(const std::filesystem::path &csv, const ObservationSidecar &sidecar, ObservationSet &set,
                           DataProblems &problems)
    {
      const CsvTable table = read_table(csv, problems);
      if (is_trackmate_table(table))
        problems.error(fmt::format("{}: this is a table of TrackMate; name it in the sidecar with its frequency: "
                                   "[[recording]] file = \"{}\", frequency_Hz = ...",
                                   table.where_header(), csv.filename().string()));
      else if (is_track_table(table))
        add_tracks(head_tracks(table, nullptr, sidecar.camera->period_start_s.value_or(0.), problems), sidecar, set,
                   problems);
      else
        read_curve(table, set, problems);
    }

    /// Points of tracks by frequency, each frequency once, at least two.
    void order_tracked_points(ObservationSet &set, DataProblems &problems)
    {
      auto &points = set.points;
      std::stable_sort(points.begin(), points.end(),
                       [](const Observation &a, const Observation &b) { return a.frequency_Hz < b.frequency_Hz; });
      for (std::size_t i = 1; i < points.size(); ++i)
        if (points[i].frequency_Hz <= points[i - 1].frequency_Hz * (1. + 1e-9))
          problems.error(
              fmt::format("{}: frequency {} Hz stands already in {}; keep one track per frequency, or put the "
                          "other into a set of its own.",
                          points[i].where, points[i].frequency_Hz, points[i - 1].where));
      if (points.size() < 2 && !problems.has_errors())
        problems.error(fmt::format("{}: {} point(s) are no curve; at least 2 frequencies are needed.",
                                   set.file.string(), points.size()));
    }

    void warn_of_sizes(ObservationSet &set, DataProblems &problems)
    {
      for (const std::string &sentence : implausible_sizes(set, set.body_length_m.value_or(centimetre_m)))
        problems.warning(sentence);
    }

    void require_sidecar(const std::filesystem::path &csv, const std::filesystem::path &toml, DataProblems &problems)
    {
      if (!std::filesystem::exists(toml))
        problems.error(fmt::format(
            "{}: the sidecar {} is missing; write it with source, synthetic, swimmer, measured_by, period and [field] "
            "bx_T, by_T (docs/file-formats.md, Observations).",
            csv.string(), toml.string()));
    }

    ObservationSet read_set(const std::filesystem::path &file, DataProblems &problems)
    {
      ObservationSet              set;
      const std::filesystem::path csv = with_extension(file, ".csv"), toml = with_extension(file, ".toml");
      set.name = file.stem().string();
      set.file = csv;
      require_sidecar(csv, toml, problems);
      ObservationSidecar sidecar;
      if (std::filesystem::exists(toml))
        sidecar = read_observation_sidecar(toml, problems);
      describe(sidecar, set);
      const bool has_camera = sidecar.camera.has_value();
      sidecar.camera        = sidecar.camera.value_or(Camera());
      if (sidecar.recordings.empty())
        problems.attempt([&] { read_table_of_set(csv, sidecar, set, problems); });
      for (const Recording &recording : sidecar.recordings)
        problems.attempt([&] { read_recording(recording, sidecar, set, problems); });
      if (set.quantity == ObservedQuantity::positions)
        order_tracked_points(set, problems);
      else if (has_camera)
        problems.warning(fmt::format("{}: [camera] is not used; {} holds no track.", toml.string(), csv.string()));
      warn_of_sizes(set, problems);
      return set;
    }
  } // namespace

  ObservationSet read_observations(const std::filesystem::path &file)
  {
    DataProblems   problems;
    ObservationSet set = read_set(file, problems);
    problems.throw_errors();
    set.warnings = problems.texts(Severity::warning);
    return set;
  }

  std::vector<DataProblem> lint_observations(const std::filesystem::path &file)
  {
    DataProblems problems;
    read_set(file, problems);
    return problems.all();
  }
} // namespace swimtwin
