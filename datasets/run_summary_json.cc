#include <datasets/csv_table.h>
#include <datasets/error.h>
#include <datasets/output_folder.h>
#include <datasets/run_summary_json.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// One list of keys for both directions: `visit(key, member)`.
    template <typename Summary, typename Visitor>
    void for_each_entry(Summary &summary, const Visitor &visit)
    {
      visit("status", summary.status);
      visit("displacement_per_period_m", summary.displacement_per_period_m);
      visit("net_displacement_m", summary.net_displacement_m);
      visit("n_unknowns", summary.n_unknowns);
      visit("n_steps", summary.n_steps);
      visit("n_linear_solves", summary.n_linear_solves);
      visit("n_factorizations", summary.n_factorizations);
      visit("n_tail_linear_solves", summary.n_tail_linear_solves);
      visit("n_tail_factorizations", summary.n_tail_factorizations);
      visit("coupling_iterations_mean", summary.coupling_iterations_mean);
      visit("n_remeshes", summary.n_remeshes);
      visit("n_step_halvings", summary.n_step_halvings);
      visit("power_imbalance", summary.power_imbalance);
      visit("worst_power_imbalance", summary.worst_power_imbalance);
      visit("wall_time_s", summary.wall_time_s);
      visit("cpu_time_s", summary.cpu_time_s);
      visit("peak_memory_MB", summary.peak_memory_MB);
      visit("warnings", summary.warnings);
    }

    template <typename ProvenanceType, typename Visitor>
    void for_each_provenance_entry(ProvenanceType &provenance, const Visitor &visit)
    {
      visit("program_version", provenance.program_version);
      visit("command_line", provenance.command_line);
      visit("scene_text", provenance.scene_text);
      visit("scene_hash", provenance.scene_hash);
      visit("created", provenance.created);
      visit("wall_time_s", provenance.wall_time_s);
    }

    template <typename Type>
    Json to_json(const Type &value)
    {
      return value;
    }
    Json to_json(const double value)
    {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    }
    Json to_json(const std::vector<double> &values)
    {
      Json array = Json::array();
      for (const double value : values)
        array.push_back(to_json(value));
      return array;
    }

    bool holds_null(const Json &entry)
    {
      return entry.is_null() || (entry.is_array() && std::any_of(entry.begin(), entry.end(), holds_null));
    }

    void flag_values_that_are_not_finite(Json &json)
    {
      std::vector<std::string> keys;
      for (const auto &[key, entry] : json.items())
        if (holds_null(entry))
          keys.push_back(key);
      if (!keys.empty() && json["status"] == "completed")
        json["status"] = fmt::format("failed: {} not finite", fmt::join(keys, ", "));
    }

    template <typename Type>
    void from_json(const Json &entry, Type &value)
    {
      value = entry.get<Type>();
    }
    void from_json(const Json &entry, double &value)
    {
      value = entry.is_null() ? std::numeric_limits<double>::quiet_NaN() : entry.get<double>();
    }
    void from_json(const Json &entry, std::vector<double> &values)
    {
      values.clear();
      for (const Json &element : entry.get<std::vector<Json>>())
        from_json(element, values.emplace_back());
    }

    class JsonObject
    {
    public:
      JsonObject(std::string file, const Json &json) : file_(std::move(file)), json_(json) {}

      template <typename Type>
      void operator()(const char *key, Type &value) const
      {
        try
        {
          from_json(json_.at(key), value);
        }
        catch (const Json::exception &)
        {
          throw InputError(fmt::format("{}: the entry {} is missing or has the wrong type.", file_, key));
        }
      }

    private:
      std::string file_;
      const Json &json_;
    };

    Json parse_json(const std::filesystem::path &file)
    {
      try
      {
        return Json::parse(read_text_file(file, "the summary"));
      }
      catch (const Json::parse_error &)
      {
        throw InputError(fmt::format("{}: this is not valid JSON.", file.string()));
      }
    }
  } // namespace

  void write_run_summary_json(const std::filesystem::path &file, const RunRecord &record)
  {
    Json       json;
    const auto add = [&json](const char *key, const auto &value) { json[key] = to_json(value); };
    for_each_entry(record.summary, add);
    json["cpu_time_of_part_s"] = Json::object();
    for (const auto &[part, seconds] : record.summary.cpu_time_of_part_s)
      json["cpu_time_of_part_s"][part] = to_json(seconds);
    flag_values_that_are_not_finite(json);

    Json      &origin        = json["provenance"];
    const auto add_to_origin = [&origin](const char *key, const auto &value) { origin[key] = to_json(value); };
    for_each_provenance_entry(record.provenance, add_to_origin);
    write_text_atomically(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  }

  RunRecord read_run_summary_json(const std::filesystem::path &file)
  {
    const Json json = parse_json(file);
    RunRecord  record;
    for_each_entry(record.summary, JsonObject(file.string(), json));
    Json parts, origin;
    JsonObject(file.string(), json)("cpu_time_of_part_s", parts);
    for (const auto &[part, seconds] : parts.items())
      from_json(seconds, record.summary.cpu_time_of_part_s.emplace_back(part, 0.).second);
    JsonObject(file.string(), json)("provenance", origin);
    for_each_provenance_entry(record.provenance, JsonObject(file.string(), origin));
    return record;
  }
} // namespace swimtwin
