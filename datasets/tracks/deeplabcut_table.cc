#include <datasets/text/unit_names.h>
#include <datasets/tracks/deeplabcut_table.h>
#include <datasets/tracks/observed_cells.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace swimtwin
{
  namespace
  {
    /// Where the coordinates of one body part stand.
    struct PartColumns
    {
      std::optional<std::size_t> x, y, likelihood;
    };

    struct PartName
    {
      std::string individual, part;

      auto        operator<=>(const PartName &) const = default;
      std::string text() const { return individual.empty() ? part : fmt::format("{} of {}", part, individual); }
    };

    struct Layout
    {
      std::map<PartName, PartColumns> parts;
      std::size_t                     first_row = 0;
    };

    Layout layout_of(const CsvTable &table)
    {
      std::map<std::string, std::size_t> rows; // of labels
      Layout                             layout;
      while (layout.first_row < table.n_rows() && !rows.contains("coords"))
        rows[table.cells(layout.first_row).front()] = layout.first_row, ++layout.first_row;
      if (!rows.contains("coords") || !rows.contains("bodyparts"))
        return {};
      const auto label = [&](const char *level, const std::size_t column) {
        return rows.contains(level) ? table.cells(rows.at(level))[column] : std::string();
      };
      for (std::size_t column = 1; column < table.column_names().size(); ++column)
      {
        PartColumns      &part  = layout.parts[{label("individuals", column), label("bodyparts", column)}];
        const std::string coord = label("coords", column);
        if (coord == "x")
          part.x = column;
        else if (coord == "y")
          part.y = column;
        else if (coord == "likelihood")
          part.likelihood = column;
      }
      return layout;
    }

    std::string list_parts(const Layout &layout)
    {
      std::vector<std::string> words;
      for (const auto &[name, columns] : layout.parts)
        words.push_back(name.text());
      return fmt::format("{}", fmt::join(words, ", "));
    }

    std::optional<PartColumns> choose_part(const CsvTable &table, const Layout &layout, const Recording &recording,
                                           DataProblems &problems)
    {
      std::vector<PartColumns> found;
      for (const auto &[name, columns] : layout.parts)
        if ((recording.body_part.empty() || name.part == recording.body_part) &&
            (recording.individual.empty() || name.individual == recording.individual))
          found.push_back(columns);
      if (found.size() == 1 && found.front().x && found.front().y)
        return found.front();
      if (found.size() == 1)
        problems.error(fmt::format("{}: the body part has no columns x and y; export the table from DeepLabCut again.",
                                   table.where_header()));
      else if (found.empty() && !layout.parts.empty())
        problems.error(fmt::format(
            "{}: body_part = \"{}\"{} is not in {}, which has {}.", recording.where, recording.body_part,
            recording.individual.empty() ? "" : fmt::format(" of individual = \"{}\"", recording.individual),
            recording.file.string(), list_parts(layout)));
      else if (found.empty())
        problems.error(
            fmt::format("{}: the header rows bodyparts and coords of DeepLabCut are not complete; export the "
                        "table again.",
                        table.where_header()));
      else
        problems.error(
            fmt::format("{}: DeepLabCut followed {}; choose the head in the sidecar, body_part (and individual) "
                        "of its [[recording]].",
                        table.where_header(), list_parts(layout)));
      return std::nullopt;
    }

    /// Of a table in pixels, or of one that was converted since, as `length_unit` says.
    std::optional<double> length_of_pixel(const CsvTable &table, const Camera &camera, DataProblems &problems)
    {
      const bool is_converted = !camera.length_unit.empty() && !is_pixel(camera.length_unit);
      if (is_converted && camera.pixel_m)
        problems.error(fmt::format("{}: the positions are in pixels of {} m by [camera] pixel_m of the sidecar, but in "
                                   "\"{}\" by its length_unit; keep pixel_m alone for a table as DeepLabCut writes it.",
                                   table.where_header(), *camera.pixel_m, camera.length_unit));
      else if (is_converted)
        return unit_factor(camera.length_unit, "m");
      else if (!camera.pixel_m)
        problems.error(fmt::format("{}: DeepLabCut writes positions in pixels; give the size of one in the sidecar, "
                                   "[camera] pixel_m.",
                                   table.where_header()));
      return camera.pixel_m;
    }

    /// An empty one is none.
    void check_likelihood(const CsvTable &table, const std::size_t row, const std::size_t column, CellFaults &faults)
    {
      if (const std::optional<double> value = table.number(row, column); value && (*value < 0. || *value > 1.))
        faults.add(row, "is no likelihood", "it lies between 0 and 1: correct it, or leave the row out");
      else if (!value && !table.cells(row)[column].empty())
        faults.add_no_number(row);
    }

    /// Frames that the network is sure of.
    std::vector<std::size_t> certain_rows(const CsvTable &table, const Layout &layout, const PartColumns &part,
                                          const double least, DataProblems &problems)
    {
      std::vector<std::size_t> rows, lines;
      CellFaults               faults(table, part.likelihood.value_or(0));
      for (std::size_t row = layout.first_row; row < table.n_rows(); ++row)
      {
        const bool is_there = !table.cells(row)[*part.x].empty() && !table.cells(row)[*part.y].empty();
        if (is_there && part.likelihood)
          check_likelihood(table, row, *part.likelihood, faults);
        if (is_there && (!part.likelihood || table.number(row, *part.likelihood).value_or(0.) >= least))
          rows.push_back(row);
        else
          lines.push_back(table.line(row));
      }
      faults.note(problems);
      const std::size_t n = table.n_rows() - layout.first_row;
      if (rows.empty())
        problems.error(
            fmt::format("{}: none of {} frames has a likelihood of at least {}; train the network further, or "
                        "lower [camera] least_likelihood in the sidecar.",
                        table.where_header(), n, least));
      else if (!lines.empty())
        problems.warning(
            fmt::format("{}: {} of {} frames are left out because their likelihood is below {} or they have no "
                        "position{}; [camera] least_likelihood of the sidecar sets the limit.",
                        table.where_header(), lines.size(), n, least, and_others(lines)));
      return rows;
    }

  } // namespace

  bool is_deeplabcut_table(const CsvTable &table)
  {
    return table.column_names().front() == "scorer" && table.n_rows() > 0 &&
           (table.cells(0).front() == "bodyparts" || table.cells(0).front() == "individuals");
  }

  std::vector<HeadTrack> deeplabcut_track(const CsvTable &table, const Recording &recording, const Camera &camera,
                                          DataProblems &problems)
  {
    DataProblems                     own;
    const Layout                     layout  = layout_of(table);
    const std::optional<PartColumns> part    = choose_part(table, layout, recording, own);
    const std::optional<double>      pixel_m = length_of_pixel(table, camera, own);
    if (!camera.frame_s)
      own.error(fmt::format("{}: DeepLabCut counts frames; give the time between two in the sidecar, [camera] frame_s.",
                            table.where_header()));
    HeadTrack track{recording.frequency_Hz, recording.period_start_s, {}, {}, {}, {}, table.where_header()};
    if (!own.has_errors())
    {
      const std::vector<std::size_t> rows = certain_rows(table, layout, *part, camera.least_likelihood, own);
      track.time_s                        = scaled_cells(table, 0, rows, *camera.frame_s, own);
      track.x_m                           = scaled_cells(table, *part->x, rows, *pixel_m, own);
      track.y_m                           = scaled_cells(table, *part->y, rows, *pixel_m, own);
      track.lines                         = table.lines(rows);
      if (track.time_s.size() == rows.size())
        require_increasing(table, 0, rows, track.time_s, own);
    }
    problems.append(own);
    return own.has_errors() ? std::vector<HeadTrack>() : std::vector<HeadTrack>{track};
  }
} // namespace swimtwin
