#include <datasets/files/input_file.h>
#include <datasets/observation/observation_files.h>
#include <datasets/system/error.h>
#include <datasets/tracks/deeplabcut_table.h>
#include <datasets/tracks/head_track.h>
#include <datasets/tracks/observed_cells.h>
#include <datasets/tracks/trackmate_table.h>
#include <twin/stream/line_reader.h>
#include <twin/stream/recorded_lines.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace swimtwin
{
  namespace
  {
    constexpr double between_tracks_s = 1., latest_s = 1e10; // a clock of microseconds counts that far in an hour

    RecordedStream stream_of_text(const std::string &text)
    {
      RecordedStream stream;
      for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end - begin <= LineReader::most_bytes)
          stream.lines.push_back({text.substr(begin, end - begin), {}, {}});
        else
          stream.lines.push_back({{}, {}, LineReader::too_long_sentence()});
        begin = end + 1;
      }
      return stream;
    }

    /// A table without the rows that are wrong in themselves, and what was read from the others.
    template <typename Content>
    struct ReadRows
    {
      CsvTable              table;
      std::vector<WrongRow> wrong; ///< in the order of the file
      Content               content;
    };

    /// `read` is asked again until it finds no more wrong rows. What is wrong with the table as a whole is noted, and
    /// then what was wrong with rows as well.
    template <typename Read>
    auto read_right_rows(CsvTable table, const Read &read, DataProblems &problems)
    {
      std::vector<WrongRow> wrong = table.left_out();
      DataProblems          of_rows;
      for (const WrongRow &row : wrong)
        of_rows.error(row.text);
      for (;;)
      {
        DataProblems own;
        auto         content = read(table, own);
        const auto   rows    = own.wrong_rows();
        if (rows.empty())
        {
          if (own.has_errors())
            problems.append(of_rows);
          problems.append(own);
          std::stable_sort(wrong.begin(), wrong.end(),
                           [](const WrongRow &a, const WrongRow &b) { return a.line < b.line; });
          return ReadRows<decltype(content)>{std::move(table), std::move(wrong), std::move(content)};
        }
        of_rows.append(own);
        wrong.insert(wrong.end(), rows.begin(), rows.end());
        table = table.without(rows);
      }
    }

    CsvTable read_table(const std::filesystem::path &file)
    {
      std::vector<std::string> left_out; // the table has them row by row
      return CsvTable::read(file, left_out);
    }

    /// Rows as lines, and the wrong ones between them.
    class RowsInOrder
    {
    public:
      RowsInOrder(std::string file, const std::vector<WrongRow> &wrong, std::vector<RecordedLine> &lines)
          : file_(std::move(file)), wrong_(wrong), lines_(lines)
      {
      }

      void add(const std::size_t line, std::string text)
      {
        while (next_ < wrong_.size() && wrong_[next_].line < line)
          add_fault();
        lines_.push_back({std::move(text), fmt::format("{}:{}", file_, line), {}});
      }
      void finish()
      {
        while (next_ < wrong_.size())
          add_fault();
      }

    private:
      void add_fault() { lines_.push_back({{}, {}, wrong_[next_++].text}); }

      std::string                  file_;
      const std::vector<WrongRow> &wrong_;
      std::size_t                  next_ = 0;
      std::vector<RecordedLine>   &lines_;
    };

    /// Beyond such times there would be no room for later tracks.
    void refuse_impossible_times(const std::string &file, const std::vector<std::size_t> &lines,
                                 const std::vector<double> &time_s, DataProblems &problems)
    {
      for (std::size_t i = 0; i < time_s.size(); ++i)
        if (std::abs(time_s[i]) > latest_s)
        {
          const std::string text = fmt::format("{}:{}: no clock says {:.4g} s; correct the time, or leave the row out.",
                                               file, lines[i], time_s[i]);
          problems.error(text, {{lines[i], text}});
        }
    }

    bool is_field_log(const CsvTable &table)
    {
      return find_quantity(table, "bx_T") && find_quantity(table, "x_m");
    }

    struct FieldLog
    {
      std::vector<double>      time_s, bx_T, by_T, x_m, y_m, angle_rad;
      std::vector<std::size_t> lines;
    };

    FieldLog read_log(const CsvTable &table, DataProblems &problems)
    {
      std::vector<std::size_t> rows(table.n_rows());
      std::iota(rows.begin(), rows.end(), std::size_t(0));
      FieldLog log{finite_cells(table, "time_s", "s", problems),
                   finite_cells(table, "bx_T", "T", problems),
                   finite_cells(table, "by_T", "T", problems),
                   finite_cells(table, "x_m", "m", problems),
                   finite_cells(table, "y_m", "m", problems),
                   {},
                   table.lines(rows)};
      if (find_quantity(table, "angle_rad"))
        log.angle_rad = finite_cells(table, "angle_rad", "rad", problems);
      if (rows.empty())
        problems.error(fmt::format("{}: there are no rows; a log needs a row per frame.", table.where_header()));
      if (problems.has_errors())
        return log;
      refuse_impossible_times(table.file(), log.lines, log.time_s, problems);
      if (problems.has_errors())
        return log;
      require_increasing(table, find_quantity(table, "time_s")->index, rows, log.time_s, problems);
      return log;
    }

    RecordedStream stream_of_log(const CsvTable &whole)
    {
      DataProblems problems;
      const auto   read = read_right_rows(whole, read_log, problems);
      problems.throw_errors();
      const FieldLog &log = read.content;
      RecordedStream  stream;
      RowsInOrder     rows(read.table.file(), read.wrong, stream.lines);
      for (std::size_t i = 0; i < log.time_s.size(); ++i)
      {
        rows.add(log.lines[i], fmt::format(R"({{"type":"field","time_s":{},"bx_T":{},"by_T":{}}})", log.time_s[i],
                                           log.bx_T[i], log.by_T[i]));
        const std::string angle = log.angle_rad.empty() ? "" : fmt::format(R"(,"angle_rad":{})", log.angle_rad[i]);
        rows.add(log.lines[i], fmt::format(R"({{"type":"frame","time_s":{},"x_m":{},"y_m":{}{}}})", log.time_s[i],
                                           log.x_m[i], log.y_m[i], angle));
      }
      rows.finish();
      return stream;
    }

    /// Of one table, and its rows that are wrong.
    struct TableTracks
    {
      std::string            file;
      std::vector<WrongRow>  wrong;
      std::vector<HeadTrack> tracks;
    };

    template <typename Read>
    TableTracks read_tracks(const std::filesystem::path &file, const Read &read, DataProblems &problems)
    {
      const auto possible = [&](const CsvTable &table, DataProblems &own) {
        std::vector<HeadTrack> tracks = read(table, own);
        for (const HeadTrack &track : tracks)
          refuse_impossible_times(table.file(), track.lines, track.time_s, own);
        return tracks;
      };
      auto rows = read_right_rows(read_table(file), possible, problems);
      return {rows.table.file(), std::move(rows.wrong), std::move(rows.content)};
    }

    TableTracks tracks_of_recording(const Recording &recording, const Camera &camera, DataProblems &problems)
    {
      return read_tracks(
          recording.file,
          [&](const CsvTable &table, DataProblems &own) {
            if (is_trackmate_table(table))
              return trackmate_track(table, recording, camera, own);
            if (is_deeplabcut_table(table))
              return deeplabcut_track(table, recording, camera, own);
            return head_tracks(table, &recording, recording.period_start_s, own);
          },
          problems);
    }

    std::vector<TableTracks> tracks_of(const std::filesystem::path &file, const ObservationSidecar &sidecar,
                                       DataProblems &problems)
    {
      const Camera                camera = sidecar.camera.value_or(Camera());
      const std::filesystem::path table  = table_to_read(file, sidecar, problems);
      if (!table.empty())
        return {read_tracks(
            table,
            [&](const CsvTable &rows, DataProblems &own) {
              return head_tracks(rows, nullptr, camera.period_start_s.value_or(0.), own);
            },
            problems)};
      std::vector<TableTracks> all;
      for (const Recording &recording : sidecar.recordings)
        all.push_back(tracks_of_recording(recording, camera, problems));
      return all;
    }

    void add_track(const HeadTrack &track, const ObservationSidecar &sidecar, double &end_s, RowsInOrder &rows,
                   std::vector<RecordedLine> &lines)
    {
      const double shift_s = lines.empty() ? 0. : end_s + between_tracks_s - track.time_s.front();
      const double start_s = shift_s + track.period_start_s; // still water and no field before it
      lines.push_back({R"({"type":"restart"})", {}, {}});
      lines.push_back({fmt::format(R"({{"type":"drive","time_s":{},"bx_T":{},"by_T":{},"frequency_Hz":{}}})", start_s,
                                   sidecar.field.bx_T(), sidecar.field.by_T(), track.frequency_Hz),
                       sidecar.file.string(),
                       {}});
      const auto        sigma_m = sidecar.camera ? sidecar.camera->position_sigma_m : std::nullopt;
      const std::string sigma   = sigma_m ? fmt::format(R"(,"position_sigma_m":{})", *sigma_m) : "";
      for (std::size_t i = 0; i < track.time_s.size(); ++i)
      {
        const std::string angle = track.angle_rad.empty() ? "" : fmt::format(R"(,"angle_rad":{})", track.angle_rad[i]);
        end_s                   = shift_s + track.time_s[i];
        rows.add(track.lines[i], fmt::format(R"({{"type":"frame","time_s":{},"x_m":{},"y_m":{}{}{}}})", end_s,
                                             track.x_m[i], track.y_m[i], angle, sigma));
      }
    }

    RecordedStream stream_of_tracks(const std::vector<TableTracks> &tables, const ObservationSidecar &sidecar)
    {
      RecordedStream stream;
      double         end_s = 0.;
      for (const TableTracks &table : tables)
      {
        RowsInOrder rows(table.file, table.wrong, stream.lines);
        for (const HeadTrack &track : table.tracks)
          add_track(track, sidecar, end_s, rows, stream.lines);
        rows.finish();
      }
      return stream;
    }
  } // namespace

  RecordedStream recorded_lines(const std::filesystem::path &file)
  {
    if (file.extension() == ".jsonl")
      return stream_of_text(read_text_file(file, "the recording"));
    if (!is_sidecar(file))
      if (const CsvTable table = read_table(file); is_field_log(table))
        return stream_of_log(table);
    const std::filesystem::path toml = is_sidecar(file) ? file : sidecar_of(file);
    if (!is_there(toml) && !is_sidecar(file))
      throw InputError(
          fmt::format("{}: the recording has no field: give it columns bx_T and by_T, or a sidecar {} with "
                      "[field] (docs/file-formats.md, Observations).",
                      file.string(), toml.string()));
    DataProblems             problems;
    const ObservationSidecar sidecar = read_observation_sidecar(toml, problems);
    const auto               tables  = tracks_of(file, sidecar, problems);
    problems.throw_errors();
    if (std::all_of(tables.begin(), tables.end(), [](const TableTracks &table) { return table.tracks.empty(); }))
      throw InputError(
          fmt::format("{}: the recording holds no track; name tracks of positions, not a curve.", file.string()));
    if (sidecar.field.waveform() != FieldProgram::Waveform::sinusoidal &&
        sidecar.field.waveform() != FieldProgram::Waveform::constant)
      throw InputError(fmt::format("{}: [field] is no sinusoid; write its samples beside the positions, in a log with "
                                   "columns time_s, bx_T, by_T, x_m, y_m.",
                                   toml.string()));
    RecordedStream stream = stream_of_tracks(tables, sidecar);
    stream.warnings       = problems.texts(Severity::warning);
    return stream;
  }

  bool recorded_with_inertia(const std::filesystem::path &recording)
  {
    const std::filesystem::path toml = is_sidecar(recording) ? recording : sidecar_of(recording);
    DataProblems                problems; // those of the sidecar are told when its tracks are read
    return recording.extension() == ".jsonl" || !is_there(toml) || read_observation_sidecar(toml, problems).has_inertia;
  }
} // namespace swimtwin
