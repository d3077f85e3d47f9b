#include <datasets/files/input_file.h>
#include <datasets/files/json_entries.h>
#include <datasets/system/error.h>
#include <datasets/text/delimited_text.h>
#include <reports/run/run_folder.h>
#include <reports/twin/twin_record.h>
#include <twin/run/twin_folder.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr long shown_rows = 3000; // more than a picture has pixels

    long count_rows(const fs::path &file)
    {
      std::ifstream in(file);
      return std::max(0L, static_cast<long>(std::count(std::istreambuf_iterator<char>(in), {}, '\n')) - 1);
    }

    bool is_text(const std::string &column)
    {
      return column == "flags" || column == "phase";
    }

    double number(const std::string &cell, const fs::path &file, const long line, const std::string &column)
    {
      if (cell.empty())
        return std::nan("");
      double     value  = 0.;
      const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (result.ec != std::errc() || result.ptr != cell.data() + cell.size())
        throw InputError(fmt::format("{}:{}: {} = \"{}\" is no number; the table is not as `twin` writes it: run the "
                                     "twin again with --force.",
                                     file.string(), line, column, cell));
      return value;
    }

    /// The first row, then every n-th, and the last.
    TwinColumns read_thinned(const fs::path &file, const long n_rows)
    {
      std::ifstream in(file);
      std::string   line;
      std::getline(in, line);
      const std::vector<std::string> names  = split_cells(line, ',');
      const long                     stride = std::max(1L, (n_rows + shown_rows - 1) / shown_rows);
      TwinColumns                    columns;
      for (const std::string &name : names)
        if (!is_text(name))
          columns[name]; // also where there are no rows
      if (!columns.contains("time_s"))
        throw InputError(
            fmt::format("{}:1: lacks the column time_s; the table is not as `twin` writes it.", file.string()));
      for (long row = 0; row < n_rows && std::getline(in, line); ++row)
      {
        if (row % stride != 0 && row != n_rows - 1)
          continue;
        const std::vector<std::string> cells = split_cells(line, ',');
        if (cells.size() != names.size())
          throw InputError(fmt::format("{}:{}: has {} cells where the header has {}; the table is not as `twin` writes "
                                       "it: run the twin again with --force.",
                                       file.string(), row + 2, cells.size(), names.size()));
        for (std::size_t i = 0; i < names.size(); ++i)
          if (!is_text(names[i]))
            columns[names[i]].push_back(number(cells[i], file, row + 2, names[i]));
      }
      return columns;
    }

    const std::vector<TwinParameterName> &known_parameters()
    {
      static const std::vector<TwinParameterName> all = {
          {"young_modulus_over_viscosity_1_s", "E/μ", "1/ms", 1e-3},
          {"magnetization_over_viscosity_A_m_Pa_s", "M/μ", "kA/(m Pa s)", 1e-3},
          {"background_bx_T", "background b_x", "mT", 1e3},
          {"background_by_T", "background b_y", "mT", 1e3},
          {"flow_x_m_s", "flow along x", "µm/s", 1e6},
          {"flow_y_m_s", "flow along y", "µm/s", 1e6},
          {"camera_scale", "camera's scale", "", 1.},
          {"camera_rotation_rad", "camera's rotation", "°", 57.29577951308232},
          {"camera_offset_x_m", "camera's offset x", "mm", 1e3},
          {"camera_offset_y_m", "camera's offset y", "mm", 1e3},
          {"camera_delay_s", "camera's delay", "ms", 1e3}};
      return all;
    }

    /// An alarm's end belongs to the one of the same name that is on.
    void add_alarm(const Json &line, std::vector<RecordedAlarm> &alarms)
    {
      const std::string name = line.value("name", "");
      if (!line.value("over", false))
        return alarms.push_back(
            {name, line.value("what", ""), line.value("remedy", ""), line.value("since_s", 0.), {}});
      const auto on =
          std::find_if(alarms.rbegin(), alarms.rend(), [&](const RecordedAlarm &a) { return a.name == name; });
      if (on != alarms.rend())
        on->until_s = line.value("time_s", 0.);
    }

    RecordedProposal::Field proposed_field(const Json &json)
    {
      return {json.at("frequency_Hz").get<double>(), json.at("largest_T").get<double>(), json.at("sd").get<double>(),
              json.at("speed_m_s").get<double>()};
    }

    void add_proposal(const Json &line, std::vector<RecordedProposal> &proposals)
    {
      RecordedProposal proposal{line.at("parameter").get<std::string>(),
                                line.at("time_s").get<double>(),
                                line.at("ahead_s").get<double>(),
                                proposed_field(line.at("as_is")),
                                {}};
      if (!line.at("proposed").is_null())
        proposal.proposed = proposed_field(line.at("proposed"));
      proposals.push_back(proposal);
    }

    /// Of a file that need not be there: each line is `what` and is added.
    template <typename Recorded>
    std::vector<Recorded> read_lines(const fs::path &file, const char *what,
                                     void (*add)(const Json &, std::vector<Recorded> &))
    {
      std::vector<Recorded> all;
      std::ifstream         in(file);
      long                  number = 0;
      for (std::string line; std::getline(in, line);)
      {
        ++number;
        const Json json = Json::parse(line, nullptr, false);
        if (!json.is_object())
          throw InputError(fmt::format("{}:{}: is no {} as `twin` writes it; run the twin again with --force.",
                                       file.string(), number, what));
        try
        {
          add(json, all);
        }
        catch (const Json::exception &)
        {
          throw InputError(fmt::format("{}:{}: has an entry of the wrong kind; run the twin again with --force.",
                                       file.string(), number));
        }
      }
      return all;
    }

    std::string sentence(const Json &direction)
    {
      std::vector<std::string> parts;
      for (const auto &[name, weight] : direction.at("direction").items())
        parts.push_back(fmt::format("{:+.2f} {}", weight.get<double>(), name));
      return fmt::format("{} ({:.0f} % of the prior's variance is left)", fmt::join(parts, " "),
                         100. * direction.at("variance_left").get<double>());
    }

    void read_summary(const fs::path &file, TwinRecord &record)
    {
      const Json json = read_json_file(file, "the twin's summary", "run the twin again with --force");
      try
      {
        record.status = json.at("status").get<std::string>();
        for (const auto &[name, n] : json.at("counts").items())
          record.counts[name] = n.get<long>();
        for (const Json &direction : json.at("keeps_its_prior"))
          record.keeps_its_prior.push_back(sentence(direction));
        if (json.contains("goal"))
        {
          const Json &goal     = json.at("goal");
          record.phase         = goal.at("phase").get<std::string>();
          record.path_length_m = goal.at("path_length_m").get<double>();
          record.arc_m         = goal.at("arc_m").get<double>();
          for (const Json &point : goal.at("path_m"))
            record.path_m.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
        }
        read_json(json.at("provenance"), record.provenance.emplace());
      }
      catch (const Json::exception &)
      {
        throw InputError(fmt::format("{} is not as `twin` writes it; run the twin again with --force.", file.string()));
      }
      catch (const InputError &error)
      {
        throw InputError(fmt::format("{} {}; run the twin again with --force.", file.string(), error.what()));
      }
    }
  } // namespace

  bool is_twin(const fs::path &folder)
  {
    std::error_code error;
    return fs::exists(folder / twin_table_name, error);
  }

  TwinRecord read_twin_record(const fs::path &folder)
  {
    TwinRecord record;
    record.name    = folder_name(folder);
    record.n_rows  = count_rows(folder / twin_table_name);
    record.columns = read_thinned(folder / twin_table_name, record.n_rows);
    for (const TwinParameterName &p : known_parameters())
      if (record.columns.contains(p.column) && record.columns.contains("sd_of_" + p.column))
        record.parameters.push_back(p);
    std::error_code error;
    if (fs::exists(folder / steering_name, error))
    {
      record.n_steering_rows = count_rows(folder / steering_name);
      record.steering        = read_thinned(folder / steering_name, record.n_steering_rows);
    }
    record.alarms    = read_lines<RecordedAlarm>(folder / alarms_name, "alarm", add_alarm);
    record.proposals = read_lines<RecordedProposal>(folder / proposals_name, "proposal", add_proposal);
    if (fs::exists(folder / twin_summary_name, error))
      read_summary(folder / twin_summary_name, record);
    return record;
  }
} // namespace swimtwin
