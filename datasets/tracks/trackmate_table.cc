#include <datasets/tracks/observed_cells.h>
#include <datasets/tracks/spot_tracks.h>
#include <datasets/tracks/trackmate_table.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    bool has_columns(const CsvTable &table, const SpotColumns &columns, const Camera &camera, DataProblems &problems)
    {
      const std::size_t before  = problems.all().size();
      const auto        require = [&](const bool there, const char *name, const char *reason = "") {
        if (!there)
          problems.error(
                     fmt::format("{}: the column {} is missing{}; export the spots of the tracks with TrackMate, not "
                                        "edges or tracks, and delete no column.",
                                 table.where_header(), name, reason));
      };
      require(columns.x.has_value(), "POSITION_X");
      require(columns.y.has_value(), "POSITION_Y");
      require(columns.track.has_value(), "TRACK_ID");
      if (camera.frame_s)
        require(columns.frame.has_value(), "FRAME", ", which frame_s of the sidecar counts");
      else if (!columns.time && columns.frame)
        problems.error(fmt::format("{}: there is no column of times; give the time between two frames in the sidecar, "
                                   "[camera] frame_s.",
                                   table.where_header()));
      else
        require(columns.time.has_value(), "POSITION_T");
      return problems.all().size() == before;
    }

    /// Fiji takes an image without a calibration to have one frame per second.
    void warn_of_uncalibrated_time(const CsvTable &table, const SpotColumns &columns, const SpotClock &clock,
                                   const std::vector<std::size_t> &rows, DataProblems &problems)
    {
      if (clock.column != columns.time || !columns.frame || rows.size() < 2)
        return;
      for (const std::size_t row : rows)
        if (table.number(row, *columns.frame) != table.number(row, *columns.time))
          return;
      problems.warning(fmt::format("{}: POSITION_T equals FRAME, one frame per second: if the images had no frame "
                                   "interval in Fiji, give [camera] frame_s in the sidecar.",
                                   table.where(rows.front())));
    }

    /// The sidecar's frame interval wins over a calibrated film's; it should not contradict it unseen.
    void warn_of_another_interval(const CsvTable &table, const SpotColumns &columns, const Camera &camera,
                                  const std::vector<std::size_t> &rows, DataProblems &problems)
    {
      if (!camera.frame_s || !columns.time || !columns.frame || rows.size() < 2)
        return;
      Camera without = camera;
      without.frame_s.reset();
      DataProblems ignored;
      const auto   clock = find_clock(table, columns, without, ignored);
      const auto   span  = [&](const std::size_t column) {
        return table.number(rows.back(), column).value_or(0.) - table.number(rows.front(), column).value_or(0.);
      };
      const double n_frames = span(*columns.frame);
      if (!clock || n_frames <= 0.)
        return;
      const double interval = clock->unit_s * span(clock->column) / n_frames;
      if (interval != 1. && std::abs(interval / *camera.frame_s - 1.) > 0.02)
        problems.warning(
            fmt::format("{}: POSITION_T says {:.4g} s between two frames, [camera] frame_s of the sidecar {:.4g} "
                        "s, which is used; check which is right.",
                        table.where(rows.front()), interval, *camera.frame_s));
    }
  } // namespace

  bool is_trackmate_table(const CsvTable &table)
  {
    const SpotColumns columns = find_spot_columns(table);
    return table.has_column("POSITION_X") || table.has_column("TRACK_ID") ||
           (columns.x && columns.y && columns.track && (columns.time || columns.frame));
  }

  std::optional<std::size_t> find_row_of_keys(const CsvTable &table)
  {
    for (std::size_t row = 0; row < table.n_rows(); ++row)
      for (const std::string &cell : table.cells(row))
        if (cell == "POSITION_X" || cell == "TRACK_ID")
          return row;
    return std::nullopt;
  }

  std::vector<HeadTrack> trackmate_track(const CsvTable &table, const Recording &recording, const Camera &camera,
                                         DataProblems &problems)
  {
    DataProblems      own;
    const SpotColumns columns = find_spot_columns(table);
    HeadTrack         track{recording.frequency_Hz, recording.period_start_s, {}, {}, {}, {}, table.where_header()};
    if (has_columns(table, columns, camera, own))
    {
      const std::optional<double>    unit  = length_of_unit(table, columns, camera, own);
      const std::optional<SpotClock> clock = find_clock(table, columns, camera, own);
      const SpotClock                any{camera.frame_s ? *columns.frame : *columns.time, 1.};
      const std::vector<std::size_t> rows = spots_of_track(table, columns, clock.value_or(any), recording, own);
      if (unit && clock && !rows.empty())
      {
        warn_of_uncalibrated_time(table, columns, *clock, rows, own);
        warn_of_another_interval(table, columns, camera, rows, own);
        track.time_s = scaled_cells(table, clock->column, rows, clock->unit_s, own);
        track.x_m    = scaled_cells(table, *columns.x, rows, *unit, own);
        track.y_m    = scaled_cells(table, *columns.y, rows, *unit, own);
        track.lines  = table.lines(rows);
      }
    }
    problems.append(own);
    return own.has_errors() ? std::vector<HeadTrack>() : std::vector<HeadTrack>{track};
  }
} // namespace swimtwin
