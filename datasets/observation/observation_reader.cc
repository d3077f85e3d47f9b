#include <datasets/observation/observation_curve.h>
#include <datasets/observation/observation_files.h>
#include <datasets/observation/observation_names.h>
#include <datasets/observation/observation_set.h>
#include <datasets/observation/track_observation.h>
#include <datasets/tracks/data_problems.h>
#include <datasets/tracks/deeplabcut_table.h>
#include <datasets/tracks/observation_sidecar.h>
#include <datasets/tracks/trackmate_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr double centimetre_m = 1e-2; // micro-robots are not longer

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
      set.has_inertia   = sidecar.has_inertia;
      set.dimension     = sidecar.dimension;
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
      else if (is_deeplabcut_table(table))
        add_tracks(deeplabcut_track(table, recording, *sidecar.camera, problems), sidecar, set, problems);
      else if (const auto row = find_row_of_keys(table))
        problems.error(fmt::format("{}: TrackMate's names of the columns stand on line {}; move that line to the top.",
                                   table.where_header(), table.line(*row)));
      else
        add_tracks(head_tracks(table.with_units_in_names(), &recording, recording.period_start_s, problems), sidecar,
                   set, problems);
    }

    void read_table_of_set(const std::filesystem::path &file, const ObservationSidecar &sidecar, ObservationSet &set,
                           DataProblems &problems)
    {
      const CsvTable table = read_table(file, problems);
      if (is_trackmate_table(table) || is_deeplabcut_table(table))
        problems.error(fmt::format("{}: this is a table of {}; name it in the sidecar with its frequency: "
                                   "[[recording]] file = \"{}\", frequency_Hz = ...",
                                   table.where_header(), is_trackmate_table(table) ? "TrackMate" : "DeepLabCut",
                                   file.filename().string()));
      else if (const CsvTable named = table.with_units_in_names(); is_track_table(named))
        add_tracks(head_tracks(named, nullptr, sidecar.camera->period_start_s.value_or(0.), problems), sidecar, set,
                   problems);
      else
        read_curve(named, set, problems);
    }

    bool are_the_same(const Recording &a, const Recording &b)
    {
      return a.file.lexically_normal() == b.file.lexically_normal() && a.track_ids == b.track_ids &&
             a.body_part == b.body_part && a.individual == b.individual && a.period_start_s == b.period_start_s;
    }

    /// Films of one frequency are replicates; one film twice is not.
    void refuse_copies(const std::vector<Recording> &recordings, DataProblems &problems)
    {
      for (std::size_t i = 0; i < recordings.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (are_the_same(recordings[i], recordings[j]))
            problems.error(fmt::format("{}: the same track of {} at frequency {} Hz stands already in {}, at {} Hz; "
                                       "one film is one measurement: "
                                       "leave one of them out, or tell them apart by track_id or period_start_s.",
                                       recordings[i].where, recordings[i].file.string(), recordings[i].frequency_Hz,
                                       recordings[j].where, recordings[j].frequency_Hz));
    }

    /// Points of tracks by frequency, at least two.
    void order_tracked_points(ObservationSet &set, DataProblems &problems)
    {
      auto &points = set.points;
      std::stable_sort(points.begin(), points.end(),
                       [](const Observation &a, const Observation &b) { return a.frequency_Hz < b.frequency_Hz; });
      if (points.size() < 2 && !problems.has_errors())
        problems.error(fmt::format("{}: {} point(s) are no curve; at least 2 tracks are needed.", set.file.string(),
                                   points.size()));
    }

    void warn_of_sizes(ObservationSet &set, DataProblems &problems)
    {
      for (const std::string &sentence : implausible_sizes(set, set.body_length_m.value_or(centimetre_m)))
        problems.warning(sentence);
    }

    void note_missing_sidecar(const std::filesystem::path &table, const std::filesystem::path &toml,
                              DataProblems &problems)
    {
      problems.error(fmt::format(
          "{}: the sidecar {} is missing; write it with source, synthetic, swimmer, measured_by, period and [field] "
          "bx_T, by_T (docs/file-formats.md, Observations).",
          table.string(), toml.string()));
    }

    /// The table, or without one the recordings of the sidecar.
    void read_what_was_seen(const std::filesystem::path &table, ObservationSidecar &sidecar, ObservationSet &set,
                            DataProblems &problems)
    {
      const bool has_camera = sidecar.camera.has_value();
      sidecar.camera        = sidecar.camera.value_or(Camera());
      if (!table.empty())
        problems.attempt([&] { read_table_of_set(table, sidecar, set, problems); });
      else
      {
        refuse_copies(sidecar.recordings, problems);
        for (const Recording &recording : sidecar.recordings)
          problems.attempt([&] { read_recording(recording, sidecar, set, problems); });
      }
      if (set.quantity == ObservedQuantity::positions)
        order_tracked_points(set, problems);
      else if (has_camera && !table.empty())
        problems.warning(
            fmt::format("{}: [camera] is not used; {} holds no track.", sidecar.file.string(), table.string()));
    }

    ObservationSet read_set(const std::filesystem::path &named, DataProblems &problems)
    {
      ObservationSet              set;
      const std::filesystem::path toml = is_sidecar(named) ? named : sidecar_of(named);
      ObservationSidecar          sidecar;
      sidecar.file = toml;
      if (is_folder(named) || (!is_there(toml) && !is_there(named)))
      {
        problems.attempt([&] { read_text_file(named, "the observations"); });
        return set;
      }
      if (is_there(toml))
        sidecar = read_observation_sidecar(toml, problems);
      else
        note_missing_sidecar(named, toml, problems);
      const std::filesystem::path table = table_to_read(named, sidecar, problems);
      set.name                          = named.stem().string();
      set.file                          = table.empty() ? toml : table;
      describe(sidecar, set);
      read_what_was_seen(table, sidecar, set, problems);
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

  std::vector<ObservationSet> read_observations(const std::vector<std::filesystem::path> &files)
  {
    std::vector<ObservationSet> sets;
    DataProblems                problems;
    for (const auto &file : files)
      problems.attempt([&] { sets.push_back(read_observations(file)); });
    refuse_repeated_files(sets, problems);
    problems.throw_errors();
    name_apart(sets);
    return sets;
  }

  std::vector<DataProblem> lint_observations(const std::filesystem::path &file)
  {
    DataProblems problems;
    read_set(file, problems);
    return problems.all();
  }
} // namespace swimtwin
