#include <datasets/files/json_entries.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace swimtwin
{
  template <Like<WorkBalance> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("magnetic_J_m", v.magnetic_J_m);
    visit("external_J_m", v.external_J_m);
    visit("dissipated_J_m", v.dissipated_J_m);
    visit("stored_J_m", v.stored_J_m);
    visit("outflow_J_m", v.outflow_J_m);
    visit("stabilization_J_m", v.stabilization_J_m);
    visit("numerical_J_m", v.numerical_J_m);
  }

  template <Like<InertiaRecord> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("kept", v.kept);
    visit("fluid_share", v.fluid_share);
    visit("tail_share", v.tail_share);
    visit("head_share", v.head_share);
    visit("neglected_share", v.neglected_share);
  }

  constexpr const char *key_of_linear_iterations = "linear_iterations_mean";

  template <Like<RunSummary> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("status", v.status);
    visit("displacement_per_period_m", v.displacement_per_period_m);
    visit("net_displacement_m", v.net_displacement_m);
    visit("n_unknowns", v.n_unknowns);
    visit("n_steps", v.n_steps);
    visit("n_linear_solves", v.n_linear_solves);
    visit("n_factorizations", v.n_factorizations);
    visit("n_tail_linear_solves", v.n_tail_linear_solves);
    visit("n_tail_factorizations", v.n_tail_factorizations);
    visit(key_of_linear_iterations, v.linear_iterations_mean);
    visit("coupling_iterations_mean", v.coupling_iterations_mean);
    visit("n_remeshes", v.n_remeshes);
    visit("n_step_halvings", v.n_step_halvings);
    visit("power_imbalance", v.power_imbalance);
    visit("worst_power_imbalance", v.worst_power_imbalance);
    visit("work_of_last_period", v.work_of_last_period);
    visit("inertia", v.inertia);
    visit("wall_time_s", v.wall_time_s);
    visit("cpu_time_s", v.cpu_time_s);
    visit("peak_memory_MB", v.peak_memory_MB);
    visit("warnings", v.warnings);
    visit("cpu_time_of_part_s", v.cpu_time_of_part_s);
  }

  namespace
  {
    bool holds_null(const Json &entry)
    {
      return entry.is_null() || (entry.is_structured() && std::any_of(entry.begin(), entry.end(), holds_null));
    }

    template <typename Type>
    bool is_finite(const Type &value)
    {
      return !holds_null(json_of(value));
    }
    /// What was not computed is not wrong.
    template <typename Type>
    bool is_finite(const std::optional<Type> &value)
    {
      return !value || is_finite(*value);
    }

    std::vector<std::string> keys_that_are_not_finite(const RunSummary &summary)
    {
      std::vector<std::string> keys;
      for_each_entry(summary, [&](const char *key, const auto &member) {
        if (!is_finite(member))
          keys.emplace_back(key);
      });
      return keys;
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
          read_entry(json_, key, value);
        }
        catch (const InputError &)
        {
          throw InputError(fmt::format("{}: the entry {} is missing or has the wrong type.", file_, key));
        }
      }
      /// Runs of earlier versions lack one of them, and the next two.
      void operator()(const char *key, std::optional<double> &value) const
      {
        if (std::string_view(key) != key_of_linear_iterations || json_.contains(key))
          operator()<std::optional<double>>(key, value);
      }
      void operator()(const char *key, std::optional<InertiaRecord> &value) const
      {
        if (json_.contains(key))
          operator()<std::optional<InertiaRecord>>(key, value);
      }
      void operator()(const char *key, std::optional<WorkBalance> &value) const
      {
        if (!json_.contains(key))
          return;
        Json padded = {{key, json_.at(key)}};
        for (const char *later : {"outflow_J_m", "stabilization_J_m", "numerical_J_m"})
          if (padded[key].is_object() && !padded[key].contains(later))
            padded[key][later] = 0.;
        JsonObject(file_, padded).operator()<std::optional<WorkBalance>>(key, value);
      }

    private:
      std::string file_;
      const Json &json_;
    };
  } // namespace

  void write_run_summary_json(const std::filesystem::path &file, const RunRecord &record)
  {
    Json json = json_of(record.summary);
    if (const auto keys = keys_that_are_not_finite(record.summary);
        !keys.empty() && record.summary.status == "completed")
      json["status"] = fmt::format("failed: {} not finite", fmt::join(keys, ", "));
    json["provenance"] = json_of(record.provenance);
    write_json_file(file, json);
  }

  RunRecord read_run_summary_json(const std::filesystem::path &file)
  {
    const Json json = read_json_file(file, "the summary", "run again with --force");
    RunRecord  record;
    for_each_entry(record.summary, JsonObject(file.string(), json));
    const Json origin = json.value("provenance", Json::object());
    for_each_entry(record.provenance, JsonObject(file.string(), origin));
    return record;
  }
} // namespace swimtwin
