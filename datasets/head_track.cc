#include <datasets/head_track.h>
#include <datasets/observed_cells.h>

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
      std::map<double, std::vector<std::size_t>> groups;
      const std::vector<double>                  frequency_Hz =
          recording != nullptr ? std::vector<double>(table.n_rows(), recording->frequency_Hz)
                                                : positive_cells(table, "frequency_Hz", "give the frequency of the field", problems);
      for (std::size_t row = 0; row < frequency_Hz.size(); ++row)
        groups[frequency_Hz[row]].push_back(row);
      return groups;
    }

    void check_times(const CsvTable &table, const std::vector<std::size_t> &rows, const HeadTrack &track,
                     DataProblems &problems)
    {
      double latest = track.time_s.front();
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (track.time_s[i] > latest)
          latest = track.time_s[i];
        else
          problems.error(fmt::format("{}: {} does not come after {} s; sort the rows by time and keep one per instant.",
                                     table.where(rows[i]), table.quote(rows[i], "time_s"), latest));
    }

    std::vector<double> pick(const std::vector<double> &values, const std::vector<std::size_t> &rows)
    {
      std::vector<double> picked;
      for (const std::size_t row : rows)
        if (row < values.size())
          picked.push_back(values[row]);
      return picked;
    }
  } // namespace

  bool is_track_table(const CsvTable &table)
  {
    return table.has_column("time_s") || table.has_column("x_m");
  }

  std::vector<HeadTrack> head_tracks(const CsvTable &table, const Recording *recording, const double period_start_s,
                                     DataProblems &problems)
  {
    DataProblems              own;
    const std::vector<double> time_s = finite_cells(table, "time_s", "s of the camera's clock", own);
    const std::vector<double> x_m    = finite_cells(table, "x_m", "m", own);
    const std::vector<double> y_m    = finite_cells(table, "y_m", "m", own);
    const std::vector<double> angle_rad =
        table.has_column("angle_rad") ? finite_cells(table, "angle_rad", "rad", own) : std::vector<double>();
    if (recording != nullptr && table.has_column("frequency_Hz"))
      own.warning(
          fmt::format("{}: the column frequency_Hz is not used; the [[recording]] says {} Hz for the whole file.",
                      table.where_header(), recording->frequency_Hz));
    std::vector<HeadTrack> tracks;
    const auto             groups = rows_by_frequency(table, recording, own);
    if (!own.has_errors() && groups.empty())
      own.error(fmt::format("{}: there are no rows; a track needs a row per frame.", table.where_header()));
    if (!own.has_errors())
      for (const auto &[frequency_Hz, rows] : groups)
      {
        HeadTrack track{frequency_Hz,    period_start_s,        pick(time_s, rows),       pick(x_m, rows),
                        pick(y_m, rows), pick(angle_rad, rows), table.where(rows.front())};
        check_times(table, rows, track, own);
        if (rows.size() < n_rows_min)
          own.error(fmt::format("{}: {} rows at {} Hz are not a track; at least {} are needed, and many per period.",
                                table.where(rows.front()), rows.size(), frequency_Hz, n_rows_min));
        tracks.push_back(std::move(track));
      }
    problems.append(own);
    return own.has_errors() ? std::vector<HeadTrack>() : tracks;
  }
} // namespace swimtwin
