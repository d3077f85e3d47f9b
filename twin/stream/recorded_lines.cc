#include <datasets/files/input_file.h>
#include <datasets/observation/observation_files.h>
#include <datasets/system/error.h>
#include <datasets/tracks/deeplabcut_table.h>
#include <datasets/tracks/head_track.h>
#include <datasets/tracks/observed_cells.h>
#include <datasets/tracks/trackmate_table.h>
#include <twin/stream/recorded_lines.h>

#include <fmt/format.h>

#include <optional>

namespace swimtwin
{
  namespace
  {
    constexpr double between_tracks_s = 1.;

    std::vector<std::string> lines_of_text(const std::string &text)
    {
      std::vector<std::string> lines;
      for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
      }
      return lines;
    }

    bool is_field_log(const CsvTable &table)
    {
      return find_quantity(table, "bx_T") && find_quantity(table, "x_m");
    }

    std::vector<std::string> lines_of_log(const CsvTable &table)
    {
      DataProblems problems;
      const auto   time_s = finite_cells(table, "time_s", "s", problems),
                 bx_T = finite_cells(table, "bx_T", "T", problems), by_T = finite_cells(table, "by_T", "T", problems),
                 x_m = finite_cells(table, "x_m", "m", problems), y_m = finite_cells(table, "y_m", "m", problems);
      const auto angle_rad =
          find_quantity(table, "angle_rad") ? finite_cells(table, "angle_rad", "rad", problems) : std::vector<double>();
      problems.throw_errors();
      std::vector<std::string> lines;
      for (std::size_t i = 0; i < time_s.size(); ++i)
      {
        lines.push_back(
            fmt::format(R"({{"type":"field","time_s":{},"bx_T":{},"by_T":{}}})", time_s[i], bx_T[i], by_T[i]));
        const std::string angle = angle_rad.empty() ? "" : fmt::format(R"(,"angle_rad":{})", angle_rad[i]);
        lines.push_back(
            fmt::format(R"({{"type":"frame","time_s":{},"x_m":{},"y_m":{}{}}})", time_s[i], x_m[i], y_m[i], angle));
      }
      return lines;
    }

    std::vector<HeadTrack> tracks_of_recording(const Recording &recording, const Camera &camera, DataProblems &problems)
    {
      const CsvTable table = CsvTable::read(recording.file);
      if (is_trackmate_table(table))
        return trackmate_track(table, recording, camera, problems);
      if (is_deeplabcut_table(table))
        return deeplabcut_track(table, recording, camera, problems);
      return head_tracks(table, &recording, recording.period_start_s, problems);
    }

    std::vector<HeadTrack> tracks_of(const std::filesystem::path &file, const ObservationSidecar &sidecar,
                                     DataProblems &problems)
    {
      const Camera                camera = sidecar.camera.value_or(Camera());
      const std::filesystem::path table  = table_to_read(file, sidecar, problems);
      if (!table.empty())
        return head_tracks(CsvTable::read(table), nullptr, camera.period_start_s.value_or(0.), problems);
      std::vector<HeadTrack> all;
      for (const Recording &recording : sidecar.recordings)
        for (HeadTrack &track : tracks_of_recording(recording, camera, problems))
          all.push_back(std::move(track));
      return all;
    }

    void add_track(const HeadTrack &track, const ObservationSidecar &sidecar, double &end_s,
                   std::vector<std::string> &lines)
    {
      const double shift_s = lines.empty() ? 0. : end_s + between_tracks_s - track.time_s.front();
      const double start_s = shift_s + track.period_start_s; // still water and no field before it
      lines.emplace_back(R"({"type":"restart"})");
      lines.push_back(fmt::format(R"({{"type":"drive","time_s":{},"bx_T":{},"by_T":{},"frequency_Hz":{}}})", start_s,
                                  sidecar.field.bx_T(), sidecar.field.by_T(), track.frequency_Hz));
      const auto        sigma_m = sidecar.camera ? sidecar.camera->position_sigma_m : std::nullopt;
      const std::string sigma   = sigma_m ? fmt::format(R"(,"position_sigma_m":{})", *sigma_m) : "";
      for (std::size_t i = 0; i < track.time_s.size(); ++i)
      {
        const std::string angle = track.angle_rad.empty() ? "" : fmt::format(R"(,"angle_rad":{})", track.angle_rad[i]);
        end_s                   = shift_s + track.time_s[i];
        lines.push_back(fmt::format(R"({{"type":"frame","time_s":{},"x_m":{},"y_m":{}{}{}}})", end_s, track.x_m[i],
                                    track.y_m[i], angle, sigma));
      }
    }
  } // namespace

  std::vector<std::string> recorded_lines(const std::filesystem::path &file)
  {
    if (file.extension() == ".jsonl")
      return lines_of_text(read_text_file(file, "the recording"));
    if (!is_sidecar(file))
      if (const CsvTable table = CsvTable::read(file); is_field_log(table))
        return lines_of_log(table);
    const std::filesystem::path toml = is_sidecar(file) ? file : sidecar_of(file);
    if (!std::filesystem::exists(toml) && !is_sidecar(file))
      throw InputError(
          fmt::format("{}: the recording has no field: give it columns bx_T and by_T, or a sidecar {} with "
                      "[field] (docs/file-formats.md, Observations).",
                      file.string(), toml.string()));
    DataProblems             problems;
    const ObservationSidecar sidecar = read_observation_sidecar(toml, problems);
    const auto               tracks  = tracks_of(file, sidecar, problems);
    problems.throw_errors();
    if (tracks.empty())
      throw InputError(
          fmt::format("{}: the recording holds no track; name tracks of positions, not a curve.", file.string()));
    if (sidecar.field.waveform() != FieldProgram::Waveform::sinusoidal &&
        sidecar.field.waveform() != FieldProgram::Waveform::constant)
      throw InputError(fmt::format("{}: [field] is no sinusoid; write its samples beside the positions, in a log with "
                                   "columns time_s, bx_T, by_T, x_m, y_m.",
                                   toml.string()));
    std::vector<std::string> lines;
    double                   end_s = 0.;
    for (const HeadTrack &track : tracks)
      add_track(track, sidecar, end_s, lines);
    return lines;
  }
} // namespace swimtwin
