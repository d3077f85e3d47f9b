#include <datasets/observed_cells.h>
#include <datasets/trackmate_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>

namespace swimtwin
{
  namespace
  {
    constexpr std::size_t n_further_header_rows = 3; // names, short names, units

    using Unit = std::pair<std::string_view, double>;
    constexpr std::array<Unit, 13> lengths{{{"micron", 1e-6},
                                            {"microns", 1e-6},
                                            {"µm", 1e-6},
                                            {"μm", 1e-6},
                                            {"um", 1e-6},
                                            {"micrometer", 1e-6},
                                            {"nm", 1e-9},
                                            {"mm", 1e-3},
                                            {"millimeter", 1e-3},
                                            {"cm", 1e-2},
                                            {"m", 1.},
                                            {"meter", 1.},
                                            {"inch", 0.0254}}};
    constexpr std::array<Unit, 9>  times{{{"sec", 1.},
                                          {"s", 1.},
                                          {"second", 1.},
                                          {"seconds", 1.},
                                          {"ms", 1e-3},
                                          {"msec", 1e-3},
                                          {"millisecond", 1e-3},
                                          {"min", 60.},
                                          {"minute", 60.}}};

    template <std::size_t n>
    std::optional<double> size_of(const std::array<Unit, n> &units, const std::string &name)
    {
      const auto found = std::find_if(units.begin(), units.end(), [&](const Unit &unit) { return unit.first == name; });
      return found == units.end() ? std::nullopt : std::optional(found->second);
    }

    /// Rows above the first spot: those without a number for its place.
    std::size_t n_header_rows(const CsvTable &table)
    {
      std::size_t row = 0;
      while (row < table.n_rows() && row < n_further_header_rows && !table.number(row, "POSITION_X"))
        ++row;
      return row;
    }

    /// `(micron)` in the units row -> `micron`; empty without a units row.
    std::string unit_of(const CsvTable &table, const std::string &column, const std::size_t n_headers)
    {
      if (n_headers < n_further_header_rows || !table.has_column(column))
        return "";
      const auto       &names = table.column_names();
      const std::size_t index = static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
      const std::string &cell = table.cells(n_further_header_rows - 1)[index];
      const bool         inside = cell.size() > 2 && cell.front() == '(' && cell.back() == ')';
      return inside ? cell.substr(1, cell.size() - 2) : cell;
    }

    bool is_pixel(const std::string &unit)
    {
      return unit.empty() || unit == "pixel" || unit == "pixels" || unit == "px";
    }

    /// Metres per unit of POSITION_X and POSITION_Y.
    std::optional<double> length_of_unit(const CsvTable &table, const std::size_t n_headers, const Camera &camera,
                                         DataProblems &problems)
    {
      const std::string unit = unit_of(table, "POSITION_X", n_headers);
      if (is_pixel(unit) && !camera.pixel_m)
        problems.error(fmt::format("{}: POSITION_X is in {}; give the size of one in the sidecar, [camera] pixel_m.",
                                   table.where_header(),
                                   unit.empty() ? "an unknown unit (there is no row of units)" : "pixels"));
      if (is_pixel(unit))
        return camera.pixel_m;
      const std::optional<double> size = size_of(lengths, unit);
      if (!size)
        problems.error(
            fmt::format("{}: POSITION_X is in \"{}\", which is not a known unit of length; set the unit of the "
                        "images in Fiji (Image > Properties), or write (pixel) and give [camera] pixel_m.",
                        table.where(n_further_header_rows - 1), unit));
      else if (camera.pixel_m)
        problems.warning(fmt::format("{}: POSITION_X is in {} already; [camera] pixel_m of the sidecar is not used.",
                                     table.where(n_further_header_rows - 1), unit));
      return size;
    }

    struct Clock
    {
      std::string column;
      double      unit_s = 0.;
    };

    std::optional<Clock> find_clock(const CsvTable &table, const std::size_t n_headers, const Camera &camera,
                                    DataProblems &problems)
    {
      if (camera.frame_s)
        return Clock{"FRAME", *camera.frame_s};
      const std::string unit = unit_of(table, "POSITION_T", n_headers);
      if (const std::optional<double> size = size_of(times, unit))
        return Clock{"POSITION_T", *size};
      problems.error(
          fmt::format("{}: POSITION_T is in {}; give the time between two frames in the sidecar, "
                      "[camera] frame_s.",
                      table.where_header(),
                      unit.empty() ? "an unknown unit (there is no row of units)" : fmt::format("\"{}\"", unit)));
      return std::nullopt;
    }

    /// Fiji takes an image without a calibration to have one frame per second.
    void warn_of_uncalibrated_time(const CsvTable &table, const std::size_t first, const Clock &clock,
                                   DataProblems &problems)
    {
      if (clock.column != "POSITION_T" || !table.has_column("FRAME") || table.n_rows() < first + 2)
        return;
      for (std::size_t row = first; row < table.n_rows(); ++row)
        if (table.number(row, "FRAME") != table.number(row, "POSITION_T"))
          return;
      problems.warning(fmt::format("{}: POSITION_T equals FRAME, one frame per second: if the images had no frame "
                                   "interval in Fiji, give [camera] frame_s in the sidecar.",
                                   table.where(first)));
    }

    std::map<int, std::vector<std::size_t>> spots_by_track(const CsvTable &table, const std::size_t first)
    {
      std::map<int, std::vector<std::size_t>> spots;
      for (std::size_t row = first; row < table.n_rows(); ++row)
        if (const std::optional<double> id = table.number(row, "TRACK_ID"))
          spots[static_cast<int>(*id)].push_back(row);
      return spots;
    }

    std::string list_tracks(const std::map<int, std::vector<std::size_t>> &spots)
    {
      std::vector<std::string> words;
      for (const auto &[id, rows] : spots)
        words.push_back(fmt::format("{} ({} spots)", id, rows.size()));
      return fmt::format("{}", fmt::join(words, ", "));
    }

    std::vector<std::size_t> choose_track(const CsvTable &table, const std::size_t first, const Recording &recording,
                                          DataProblems &problems)
    {
      const auto spots = spots_by_track(table, first);
      if (spots.empty())
        problems.error(
            fmt::format("{}: no spot belongs to a track (TRACK_ID is empty); export the spots of the tracks.",
                        table.where_header()));
      else if (!recording.track_id && spots.size() > 1)
        problems.error(
            fmt::format("{}: there are {} tracks: {}; choose one in the sidecar, track_id of its [[recording]].",
                        table.where_header(), spots.size(), list_tracks(spots)));
      else if (recording.track_id && !spots.contains(*recording.track_id))
        problems.error(fmt::format("{}: track_id = {} is not in {}, which has {}.", recording.where,
                                   *recording.track_id, recording.file.string(), list_tracks(spots)));
      else
        return spots.at(recording.track_id.value_or(spots.begin()->first));
      return {};
    }

    bool has_columns(const CsvTable &table, const Camera &camera, DataProblems &problems)
    {
      bool complete = true;
      for (const std::string name : {"POSITION_X", "POSITION_Y", "TRACK_ID", camera.frame_s ? "FRAME" : "POSITION_T"})
        if (!table.has_column(name))
        {
          complete = false;
          problems.error(fmt::format("{}: the column {} is missing; export the spots of the tracks with TrackMate, not "
                                     "edges or tracks, and delete no column.",
                                     table.where_header(), name));
        }
      return complete;
    }

    /// The cell of every row times its unit; notes cells that are no numbers.
    std::vector<double> scaled(const CsvTable &table, const std::string &column, const std::vector<std::size_t> &rows,
                               const double unit, DataProblems &problems)
    {
      std::vector<double> values;
      for (const std::size_t row : rows)
        if (const std::optional<double> value = table.number(row, column))
          values.push_back(*value * unit);
        else
          problems.error(fmt::format("{}: {} is not a finite number; correct it, or leave the row out.",
                                     table.where(row), table.quote(row, column)));
      return values;
    }

    std::vector<std::size_t> in_time(const CsvTable &table, const std::string &clock, std::vector<std::size_t> rows,
                                     DataProblems &problems)
    {
      const auto time = [&](const std::size_t row) { return table.number(row, clock).value_or(0.); };
      std::stable_sort(rows.begin(), rows.end(), [&](const auto a, const auto b) { return time(a) < time(b); });
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (table.number(rows[i - 1], clock) && time(rows[i]) == time(rows[i - 1]))
          problems.error(
              fmt::format("{}: {} stands already on line {}: the track splits or merges there; keep one spot "
                          "per frame.",
                          table.where(rows[i]), table.quote(rows[i], clock), table.line(rows[i - 1])));
      return rows;
    }
  } // namespace

  bool is_trackmate_table(const CsvTable &table)
  {
    return table.has_column("POSITION_X") || table.has_column("TRACK_ID");
  }

  std::vector<HeadTrack> trackmate_track(const CsvTable &table, const Recording &recording, const Camera &camera,
                                         DataProblems &problems)
  {
    DataProblems own;
    HeadTrack    track{recording.frequency_Hz, recording.period_start_s, {}, {}, {}, {}, table.where_header()};
    if (has_columns(table, camera, own))
    {
      const std::size_t              first = n_header_rows(table);
      const std::optional<double>    unit  = length_of_unit(table, first, camera, own);
      const std::optional<Clock>     clock = find_clock(table, first, camera, own);
      const std::vector<std::size_t> spots = choose_track(table, first, recording, own);
      if (unit && clock && !spots.empty())
      {
        warn_of_uncalibrated_time(table, first, *clock, own);
        const std::vector<std::size_t> rows = in_time(table, clock->column, spots, own);
        track.time_s                        = scaled(table, clock->column, rows, clock->unit_s, own);
        track.x_m                           = scaled(table, "POSITION_X", rows, *unit, own);
        track.y_m                           = scaled(table, "POSITION_Y", rows, *unit, own);
      }
    }
    problems.append(own);
    return own.has_errors() ? std::vector<HeadTrack>() : std::vector<HeadTrack>{track};
  }
} // namespace swimtwin
