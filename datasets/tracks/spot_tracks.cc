#include <datasets/tracks/observed_cells.h>
#include <datasets/tracks/spot_tracks.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace swimtwin
{
  namespace
  {
    using Rows   = std::vector<std::size_t>;
    using Tracks = std::map<int, Rows>;

    Tracks tracks_of(const CsvTable &table, const SpotColumns &columns, DataProblems &problems)
    {
      constexpr double largest = 1e9;
      Tracks           tracks;
      CellFaults       faults(table, *columns.track);
      const Rows       names_and_units = further_header_rows(table, columns);
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        if (std::binary_search(names_and_units.begin(), names_and_units.end(), row))
          continue;
        else if (const std::optional<double> id = table.number(row, *columns.track);
                 id && *id == std::round(*id) && std::abs(*id) <= largest)
          tracks[static_cast<int>(*id)].push_back(row);
        else if (id || !says_none(table.cells(row)[*columns.track]))
          faults.add(row, "is no number of a track", "correct it, or leave it empty for a spot outside the tracks");
      faults.note(problems);
      return tracks;
    }

    std::string list_tracks(const Tracks &tracks)
    {
      constexpr std::size_t    most = 12;
      std::vector<std::string> words;
      for (const auto &[id, rows] : tracks)
        if (words.size() < most)
          words.push_back(fmt::format("{} ({} spots)", id, rows.size()));
      return fmt::format("{}{}", fmt::join(words, ", "), tracks.size() > most ? ", ..." : "");
    }

    /// Ids of the pieces, all of them in the table; none after an error.
    std::vector<int> choose_tracks(const CsvTable &table, const Tracks &tracks, const Recording &recording,
                                   DataProblems &problems)
    {
      if (tracks.empty())
        problems.error(
            fmt::format("{}: no spot belongs to a track (TRACK_ID is empty); export the spots of the tracks.",
                        table.where_header()));
      else if (recording.track_ids.empty() && tracks.size() > 1)
        problems.error(fmt::format("{}: there are {} tracks: {}; choose one in the sidecar, track_id of its "
                                   "[[recording]], or several that are pieces of one swimmer, track_id = [{}, {}].",
                                   table.where_header(), tracks.size(), list_tracks(tracks), tracks.begin()->first,
                                   std::next(tracks.begin())->first));
      else if (recording.track_ids.empty())
        return {tracks.begin()->first};
      else
      {
        for (const int id : recording.track_ids)
          if (!tracks.contains(id))
            problems.error(fmt::format("{}: track_id = {} is not in {}, which has {}.", recording.where, id,
                                       recording.file.string(), list_tracks(tracks)));
        return recording.track_ids;
      }
      return {};
    }

    bool stands_still(const CsvTable &table, const std::size_t clock, const Rows &rows)
    {
      return rows.size() > 2 && std::all_of(rows.begin(), rows.end(), [&](const std::size_t row) {
               return table.number(row, clock) == table.number(rows.front(), clock);
             });
    }

    /// The spots of one piece in order of time.
    Rows in_time(const CsvTable &table, const std::size_t clock, Rows rows, DataProblems &problems)
    {
      CellFaults faults(table, clock);
      for (const std::size_t row : rows)
        if (!table.number(row, clock))
          faults.add_no_number(row);
      std::erase_if(rows, [&](const std::size_t row) { return !table.number(row, clock); });
      if (stands_still(table, clock, rows))
      {
        problems.error(fmt::format(
            "{}: {} is {} in all {} spots, so it tells no time; give the time between two frames "
            "in the sidecar, [camera] frame_s, which counts FRAME.",
            table.where(rows.front()), table.column_names()[clock], table.cells(rows.front())[clock], rows.size()));
        return rows;
      }
      const auto time = [&](const std::size_t row) { return *table.number(row, clock); };
      std::stable_sort(rows.begin(), rows.end(), [&](const auto a, const auto b) { return time(a) < time(b); });
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (time(rows[i]) == time(rows[i - 1]))
          faults.add(
              rows[i],
              fmt::format("stands already on line {}: the track splits or merges there", table.line(rows[i - 1])),
              "keep one spot per frame");
      faults.note(problems);
      return rows;
    }

    struct Piece
    {
      int  id = 0;
      Rows rows;
    };

    class Pieces
    {
    public:
      Pieces(const CsvTable &table, const SpotColumns &columns, const SpotClock &clock, const Recording &recording)
          : table_(table), columns_(columns), clock_(clock), recording_(recording)
      {
      }

      Rows joined(std::vector<Piece> pieces, DataProblems &problems) const
      {
        std::sort(pieces.begin(), pieces.end(),
                  [&](const Piece &a, const Piece &b) { return time(a.rows.front()) < time(b.rows.front()); });
        Rows all = pieces.front().rows;
        for (std::size_t i = 1; i < pieces.size(); ++i)
        {
          const Piece &before = pieces[i - 1], &after = pieces[i];
          if (time(after.rows.front()) <= time(before.rows.back()))
            refuse_overlap(before, after, problems);
          else
            warn_of_jump(before, after, problems);
          all.insert(all.end(), after.rows.begin(), after.rows.end());
        }
        return all;
      }

    private:
      double time(const std::size_t row) const { return *table_.number(row, clock_.column); }

      void refuse_overlap(const Piece &before, const Piece &after, DataProblems &problems) const
      {
        const double last = std::min(time(before.rows.back()), time(after.rows.back()));
        problems.error(
            fmt::format("{}: tracks {} and {} of {} overlap, {} {:.6g} to {:.6g}; two spots at once are not one "
                        "swimmer: join pieces that follow each other, or name one of them.",
                        recording_.where, before.id, after.id, recording_.file.string(),
                        table_.column_names()[clock_.column], time(after.rows.front()), last));
      }

      double distance(const std::size_t a, const std::size_t b) const
      {
        const auto step = [&](const std::size_t column) {
          return table_.number(b, column).value_or(0.) - table_.number(a, column).value_or(0.);
        };
        return std::hypot(step(*columns_.x), step(*columns_.y));
      }

      double largest_speed(const Rows &rows) const
      {
        double largest = 0.;
        for (std::size_t i = 1; i < rows.size(); ++i)
          largest = std::max(largest, distance(rows[i - 1], rows[i]) / (time(rows[i]) - time(rows[i - 1])));
        return largest;
      }

      /// One swimmer is not faster between the pieces than in them.
      void warn_of_jump(const Piece &before, const Piece &after, DataProblems &problems) const
      {
        const std::size_t a = before.rows.back(), b = after.rows.front();
        const double      speed = distance(a, b) / (time(b) - time(a));
        const double      usual = std::max(largest_speed(before.rows), largest_speed(after.rows));
        if (speed > 3. * usual)
          problems.warning(
              fmt::format("{}: between tracks {} and {} of {} the spot jumps, {:.3g} times as fast as it ever "
                          "moves in them; are they one swimmer?",
                          recording_.where, before.id, after.id, recording_.file.string(), speed / usual));
      }

      const CsvTable    &table_;
      const SpotColumns &columns_;
      const SpotClock   &clock_;
      const Recording   &recording_;
    };
  } // namespace

  std::vector<std::size_t> spots_of_track(const CsvTable &table, const SpotColumns &columns, const SpotClock &clock,
                                          const Recording &recording, DataProblems &problems)
  {
    DataProblems       own;
    const Tracks       tracks = tracks_of(table, columns, own);
    std::vector<Piece> pieces;
    if (tracks.empty() && own.has_errors())
      return problems.append(own), Rows();
    for (const int id : choose_tracks(table, tracks, recording, own))
      if (tracks.contains(id))
        pieces.push_back({id, in_time(table, clock.column, tracks.at(id), own)});
    std::erase_if(pieces, [](const Piece &piece) { return piece.rows.empty(); });
    Rows rows;
    if (!own.has_errors() && !pieces.empty())
      rows = Pieces(table, columns, clock, recording).joined(pieces, own);
    problems.append(own);
    return own.has_errors() ? Rows() : rows;
  }
} // namespace swimtwin
