#include <datasets/text/unit_names.h>
#include <datasets/tracks/spot_columns.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    using Aliases = std::vector<std::string_view>; // in lower case, the first of them preferred

    const Aliases names_of_x{"position_x", "x"}, names_of_y{"position_y", "y"},
        names_of_time{"position_t", "t", "time"}, names_of_frame{"frame", "slice_n\u00B0", "slice"},
        names_of_track{"track_id", "particle", "track_n\u00B0", "track", "tid"};

    std::optional<std::size_t> find_named(const CsvTable &table, const Aliases &aliases)
    {
      const auto &names = table.column_names();
      for (const std::string_view alias : aliases)
        for (std::size_t i = 0; i < names.size(); ++i)
          if (split_brackets(names[i]).stem == alias)
            return i;
      return std::nullopt;
    }

    using Columns = std::vector<std::optional<std::size_t>>;

    bool holds_a_number(const CsvTable &table, const std::size_t row, const Columns &columns)
    {
      return std::any_of(columns.begin(), columns.end(),
                         [&](const auto &column) { return column && table.number(row, *column); });
    }

    /// Something else than a position that is missing.
    bool holds_a_word(const CsvTable &table, const std::size_t row, const Columns &columns)
    {
      return std::any_of(columns.begin(), columns.end(),
                         [&](const auto &column) { return column && !says_none(table.cells(row)[*column]); });
    }

    /// A unit as it was written, and where.
    struct WrittenUnit
    {
      std::string name, where;
    };

    /// Every unit that the table says for a column: in the header, or in a row below it. `si` tells a unit from a name.
    std::vector<WrittenUnit> units_of(const CsvTable &table, const SpotColumns &columns, const std::size_t column,
                                      const std::string_view si)
    {
      std::vector<WrittenUnit> units;
      if (const std::string unit = split_brackets(table.column_names()[column]).unit; !unit.empty())
        units.push_back({unit, table.where_header()});
      for (const std::size_t row : further_header_rows(table, columns))
      {
        const std::string     &cell  = table.cells(row)[column];
        const std::string_view inner = without_brackets(cell);
        if (inner != cell || is_pixel(cell) || unit_factor(cell, si))
          units.push_back({std::string(inner), table.where(row)});
        else if (const std::string unit = split_brackets(cell).unit; !unit.empty())
          units.push_back({unit, table.where(row)});
      }
      std::erase_if(units, [](const WrittenUnit &unit) { return unit.name.empty(); });
      return units;
    }

    bool are_alike(const std::string &a, const std::string &b)
    {
      const std::optional<double> factor = unit_factor(a, b);
      return a == b || (is_pixel(a) && is_pixel(b)) || (factor && std::abs(*factor - 1.) < 1e-12);
    }

    const std::string ask_for_length =
        "give it in the sidecar, [camera] length_unit = \"um\" (or as Fiji shows it for the film: Image > Properties), "
        "or length_unit = \"pixel\" and the size of one, pixel_m";

    /// The one unit of both coordinates; empty if the table says none; none after an error.
    std::optional<WrittenUnit> stated_length(const CsvTable &table, const SpotColumns &columns, DataProblems &problems)
    {
      std::vector<WrittenUnit> units = units_of(table, columns, *columns.x, "m");
      for (const WrittenUnit &unit : units_of(table, columns, *columns.y, "m"))
        units.push_back(unit);
      for (const WrittenUnit &unit : units)
        if (!are_alike(unit.name, units.front().name))
        {
          problems.error(fmt::format("{}: the positions are in \"{}\" here and in \"{}\" at {}; correct one of them.",
                                     unit.where, unit.name, units.front().name, units.front().where));
          return std::nullopt;
        }
      return units.empty() ? WrittenUnit() : units.front();
    }

    std::string remedy_for_length(const std::string &unit)
    {
      if (const auto repaired = repaired_unit(unit))
        return fmt::format("where the sign for micro was damaged on the way; write ({}), or save the table as UTF-8",
                           *repaired);
      return "which is not a known unit of length; set the unit of the images in Fiji (Image > Properties), or write "
             "the one that it is, such as (um), or (pixel) if the numbers are pixels, and then [camera] pixel_m";
    }

    std::string x_name(const CsvTable &table, const SpotColumns &columns)
    {
      return table.column_names()[*columns.x];
    }
  } // namespace

  bool says_none(const std::string &cell)
  {
    return cell.empty() || cell == "None" || cell == "NaN" || cell == "nan" || cell == "NA" || cell == "null";
  }

  SpotColumns find_spot_columns(const CsvTable &table)
  {
    return {find_named(table, names_of_x), find_named(table, names_of_y), find_named(table, names_of_time),
            find_named(table, names_of_frame), find_named(table, names_of_track)};
  }

  std::vector<std::size_t> further_header_rows(const CsvTable &table, const SpotColumns &columns)
  {
    std::vector<std::size_t> rows;
    bool                     is_below_a_spot = false;
    for (std::size_t row = 0; row < table.n_rows(); ++row)
      if (holds_a_number(table, row, {columns.x, columns.y, columns.time, columns.frame}))
        is_below_a_spot = true;
      else if (!is_below_a_spot ||
               (!holds_a_number(table, row, {columns.track}) && holds_a_word(table, row, {columns.x, columns.y})))
        rows.push_back(row);
    return rows;
  }

  std::optional<double> length_of_unit(const CsvTable &table, const SpotColumns &columns, const Camera &camera,
                                       DataProblems &problems)
  {
    const std::optional<WrittenUnit> stated = stated_length(table, columns, problems);
    if (!stated)
      return std::nullopt;
    const bool        is_stated = !stated->name.empty();
    const std::string unit      = is_stated ? stated->name : camera.length_unit;
    const std::string name      = x_name(table, columns);
    if (is_stated && !camera.length_unit.empty() && !are_alike(unit, camera.length_unit))
      problems.error(
          fmt::format("{}: {} is in \"{}\", but [camera] length_unit of the sidecar is \"{}\"; correct one of "
                      "them.",
                      stated->where, name, unit, camera.length_unit));
    else if (unit.empty())
      problems.error(fmt::format("{}: {} is in an unknown unit (there is no row of units){}; {}.", table.where_header(),
                                 name, camera.pixel_m ? ", and pixel_m alone does not say that it is pixels" : "",
                                 ask_for_length));
    else if (is_pixel(unit) && !camera.pixel_m)
      problems.error(fmt::format("{}: {} is in pixels; give the size of one in the sidecar, [camera] pixel_m.",
                                 table.where_header(), name));
    else if (is_pixel(unit))
      return camera.pixel_m;
    else if (const std::optional<double> size = unit_factor(unit, "m"); !size)
      problems.error(fmt::format("{}: {} is in \"{}\", {}.", stated->where, name, unit, remedy_for_length(unit)));
    else
    {
      if (camera.pixel_m)
        problems.warning(fmt::format("{}: {} is in {} already; [camera] pixel_m of the sidecar is not used.",
                                     is_stated ? stated->where : table.where_header(), name, unit));
      return size;
    }
    return std::nullopt;
  }

  std::optional<SpotClock> find_clock(const CsvTable &table, const SpotColumns &columns, const Camera &camera,
                                      DataProblems &problems)
  {
    if (camera.frame_s && columns.frame)
      return SpotClock{*columns.frame, *camera.frame_s};
    const std::vector<WrittenUnit> units = units_of(table, columns, *columns.time, "s");
    const std::string              unit  = units.empty() ? camera.time_unit : units.front().name;
    if (const std::optional<double> size = unit_factor(unit, "s"))
      return SpotClock{*columns.time, *size};
    problems.error(
        fmt::format("{}: {} is in {}; give the time between two frames in the sidecar, [camera] frame_s, or the unit, "
                    "time_unit = \"s\".",
                    table.where_header(), table.column_names()[*columns.time],
                    unit.empty() ? "an unknown unit (there is no row of units)" : fmt::format("\"{}\"", unit)));
    return std::nullopt;
  }
} // namespace swimtwin
