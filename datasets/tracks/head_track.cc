#include <datasets/tracks/head_track.h>
#include <datasets/tracks/observed_cells.h>

#include <fmt/format.h>

#include <map>

namespace swimtwin
{
  namespace
  {
    constexpr std::size_t n_rows_min = 4; // a cubic through them

    /// Rows by frequency; those of a recording all belong to its own.
    std::map<double, std::vector<std::size_t>> rows_by_frequency(const CsvTable &table, const Recording *recording,
                                                                 DataProblems &problems)
    {
      if (recording != nullptr && find_quantity(table, "frequency_Hz"))
        problems.warning(
            fmt::format("{}: the column frequency_Hz is not used; the [[recording]] says {} Hz for the whole file.",
                        table.where_header(), recording->frequency_Hz));
      std::map<double, std::vector<std::size_t>> groups;
      const std::vector<double>                  frequency_Hz =
          recording != nullptr ? std::vector<double>(table.n_rows(), recording->frequency_Hz)
                                                : positive_cells(table, "frequency_Hz", "give the frequency of the field", problems);
      for (std::size_t row = 0; row < frequency_Hz.size(); ++row)
        groups[frequency_Hz[row]].push_back(row);
      return groups;
    }

    void require_rows(const CsvTable &table, const std::vector<std::size_t> &rows, const HeadTrack &track,
                      DataProblems &problems)
    {
      if (rows.size() >= n_rows_min)
        return;
      std::vector<WrongRow> wrong;
      for (const std::size_t row : rows)
        wrong.push_back(
            {table.line(row), fmt::format("{}: a row at {} Hz, of which there are {}, is no track; at least "
                                          "{} are needed: correct the frequency, or leave the row out.",
                                          table.where(row), track.frequency_Hz, rows.size(), n_rows_min)});
      problems.error(fmt::format("{}: {} rows at {} Hz are not a track; at least {} are needed, and many per period.",
                                 track.where, rows.size(), track.frequency_Hz, n_rows_min),
                     std::move(wrong));
    }

    std::vector<double> pick(const std::vector<double> &values, const std::vector<std::size_t> &rows)
    {
      std::vector<double> picked;
      for (const std::size_t row : rows)
        if (row < values.size())
          picked.push_back(values[row]);
      return picked;
    }

    struct TrackColumns
    {
      std::vector<double> time_s, x_m, y_m, angle_rad;
    };

    TrackColumns read_columns(const CsvTable &table, DataProblems &problems)
    {
      return {finite_cells(table, "time_s", "s of the camera's clock", problems),
              finite_cells(table, "x_m", "m", problems), finite_cells(table, "y_m", "m", problems),
              find_quantity(table, "angle_rad") ? finite_cells(table, "angle_rad", "rad", problems)
                                                : std::vector<double>()};
    }

    HeadTrack make_track(const CsvTable &table, const TrackColumns &columns, const std::vector<std::size_t> &rows,
                         const double frequency_Hz, const double period_start_s, DataProblems &problems)
    {
      HeadTrack track{frequency_Hz,
                      period_start_s,
                      pick(columns.time_s, rows),
                      pick(columns.x_m, rows),
                      pick(columns.y_m, rows),
                      pick(columns.angle_rad, rows),
                      table.where(rows.front()),
                      table.lines(rows)};
      require_increasing(table, find_quantity(table, "time_s")->index, rows, track.time_s, problems);
      require_rows(table, rows, track, problems);
      return track;
    }
  } // namespace

  bool is_track_table(const CsvTable &table)
  {
    return find_quantity(table, "time_s") || find_quantity(table, "x_m");
  }

  std::vector<HeadTrack> head_tracks(const CsvTable &table, const Recording *recording, const double period_start_s,
                                     DataProblems &problems)
  {
    if (!has_names(table, {"time_s", "x_m", "y_m"}, problems) || has_row_of_units(table, problems))
      return {};
    DataProblems       own;
    const TrackColumns columns = read_columns(table, own);
    const auto         groups  = rows_by_frequency(table, recording, own);
    if (!own.has_errors() && groups.empty())
      own.error(fmt::format("{}: there are no rows; a track needs a row per frame.", table.where_header()));
    warn_of_conversions(table, {"time_s", "x_m", "y_m", "angle_rad", "frequency_Hz"}, own);
    std::vector<HeadTrack> tracks;
    if (!own.has_errors())
      for (const auto &[frequency_Hz, rows] : groups)
        tracks.push_back(make_track(table, columns, rows, frequency_Hz, period_start_s, own));
    problems.append(own);
    return own.has_errors() ? std::vector<HeadTrack>() : tracks;
  }
} // namespace swimtwin
