#include <datasets/csv_table.h>
#include <datasets/error.h>
#include <datasets/output_folder.h>
#include <datasets/plan_result.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>

namespace swimtwin
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    template <typename Type, typename Struct>
    concept Like = std::same_as<std::remove_const_t<Type>, Struct>;

    // One list of keys for both directions: `visit(key, member)`.
    template <Like<PlanTraceStep> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("n_periods", v.n_periods);
      visit("objective", v.objective);
      visit("violation", v.violation);
    }
    template <Like<PlannedField> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("name", v.name);
      visit("status", v.status);
      visit("message", v.message);
      visit("bx_T", v.bx_T);
      visit("by_T", v.by_T);
      visit("frequency_Hz", v.frequency_Hz);
      visit("start", v.start);
      visit("moves", v.moves);
      visit("mean_speed_m_s", v.mean_speed_m_s);
      visit("displacement_m", v.displacement_m);
      visit("sideways_m", v.sideways_m);
      visit("multipliers", v.multipliers);
      visit("terms", v.terms);
      visit("objective", v.objective);
      visit("largest_field_T", v.largest_field_T);
      visit("largest_slew_T_s", v.largest_slew_T_s);
      visit("largest_shape_radius", v.largest_shape_radius);
      visit("largest_strain", v.largest_strain);
      visit("largest_heading_deviation_rad", v.largest_heading_deviation_rad);
      visit("field_excess", v.field_excess);
      visit("motion_excess", v.motion_excess);
      visit("kkt_residual", v.kkt_residual);
      visit("n_evaluations", v.n_evaluations);
      visit("n_gradients", v.n_gradients);
      visit("n_periods", v.n_periods);
      visit("n_starts", v.n_starts);
      visit("trace", v.trace);
    }
    template <Like<TradeOffPoint> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("largest_multiplier", v.largest_multiplier);
      visit("tuned_speed_m_s", v.tuned_speed_m_s);
      visit("optimal_speed_m_s", v.optimal_speed_m_s);
      visit("tuned_frequency_Hz", v.tuned_frequency_Hz);
      visit("optimal_frequency_Hz", v.optimal_frequency_Hz);
      visit("tuned_status", v.tuned_status);
      visit("optimal_status", v.optimal_status);
    }
    template <Like<ReplayedField> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("name", v.name);
      visit("start_angle_rad", v.start_angle_rad);
      visit("displacement_m", v.displacement_m);
      visit("reduced_displacement_m", v.reduced_displacement_m);
      visit("mean_speed_m_s", v.mean_speed_m_s);
    }
    template <Like<PlanReplay> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("steps_per_period", v.steps_per_period);
      visit("fields", v.fields);
      visit("wall_time_s", v.wall_time_s);
    }
    template <Like<PlannedMember> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("young_modulus_Pa", v.young_modulus_Pa);
      visit("viscosity_Pa_s", v.viscosity_Pa_s);
      visit("magnetization_A_m", v.magnetization_A_m);
      visit("mean_speed_m_s", v.mean_speed_m_s);
      visit("tuned_speed_m_s", v.tuned_speed_m_s);
      visit("largest_multiplier", v.largest_multiplier);
    }
    template <Like<Provenance> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("program_version", v.program_version);
      visit("command_line", v.command_line);
      visit("scene_text", v.scene_text);
      visit("scene_hash", v.scene_hash);
      visit("created", v.created);
      visit("wall_time_s", v.wall_time_s);
    }
    template <Like<PlanResult> Type, typename Visitor>
    void for_each_entry(Type &v, const Visitor &visit)
    {
      visit("status", v.status);
      visit("message", v.message);
      visit("model_file", v.model_file);
      visit("scene_name", v.scene_name);
      visit("young_modulus_Pa", v.young_modulus_Pa);
      visit("viscosity_Pa_s", v.viscosity_Pa_s);
      visit("magnetization_A_m", v.magnetization_A_m);
      visit("heading_rad", v.heading_rad);
      visit("sample_rate_Hz", v.sample_rate_Hz);
      visit("fields", v.fields);
      visit("trade_off", v.trade_off);
      visit("members", v.members);
      visit("replay", v.replay);
      visit("warnings", v.warnings);
      visit("search_time_s", v.search_time_s);
      visit("seed", v.seed);
      visit("goal_text", v.goal_text);
      visit("provenance", v.provenance);
    }

    // Numbers that are not finite are null.
    Json to_json(const double value)
    {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    }
    template <typename Type>
    requires std::same_as<Type, std::string> || std::integral<Type> Json to_json(const Type &value)
    {
      return value;
    }
    Json to_json(const std::map<std::string, double> &values)
    {
      Json json = Json::object();
      for (const auto &[key, value] : values)
        json[key] = to_json(value);
      return json;
    }
    template <typename Type>
    Json to_json(const std::vector<Type> &values);
    template <typename Type>
    Json to_json(const std::optional<Type> &value);
    template <typename Struct>
    requires std::is_class_v<Struct> &&(!std::same_as<Struct, std::string>)Json to_json(const Struct &value)
    {
      Json json = Json::object();
      for_each_entry(value, [&](const char *key, const auto &member) { json[key] = to_json(member); });
      return json;
    }
    template <typename Type>
    Json to_json(const std::vector<Type> &values)
    {
      Json json = Json::array();
      for (const Type &value : values)
        json.push_back(to_json(value));
      return json;
    }
    template <typename Type>
    Json to_json(const std::optional<Type> &value)
    {
      return value ? to_json(*value) : Json(nullptr);
    }

    void from_json(const Json &json, double &value)
    {
      value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
    }
    template <typename Type>
    requires std::same_as<Type, std::string> || std::integral<Type>
    void from_json(const Json &json, Type &value)
    {
      value = json.get<Type>();
    }
    void from_json(const Json &json, std::map<std::string, double> &values)
    {
      for (const auto &[key, value] : json.items())
        from_json(value, values[key]);
    }
    template <typename Type>
    void from_json(const Json &json, std::vector<Type> &values);
    template <typename Type>
    void from_json(const Json &json, std::optional<Type> &value);
    template <typename Struct>
    requires std::is_class_v<Struct> &&
        (!std::same_as<Struct, std::string>)void from_json(const Json &json, Struct &value)
    {
      for_each_entry(value, [&](const char *key, auto &member) { from_json(json.at(key), member); });
    }
    template <typename Type>
    void from_json(const Json &json, std::vector<Type> &values)
    {
      if (!json.is_array())
        throw nlohmann::json::type_error::create(302, "an array is needed", &json);
      values.resize(json.size());
      for (std::size_t i = 0; i < json.size(); ++i)
        from_json(json[i], values[i]);
    }
    template <typename Type>
    void from_json(const Json &json, std::optional<Type> &value)
    {
      if (json.is_null())
        return value.reset();
      from_json(json, value.emplace());
    }
  } // namespace

  const PlannedField *PlanResult::find(const std::string &name) const
  {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const PlannedField &f) { return f.name == name; });
    return found == fields.end() ? nullptr : &*found;
  }

  double PlanResult::gain() const
  {
    const PlannedField *tuned = find(tuned_field_name), *optimal = find(optimal_field_name);
    if (tuned == nullptr || optimal == nullptr || !tuned->moves || !optimal->moves)
      return std::numeric_limits<double>::quiet_NaN();
    return optimal->mean_speed_m_s / tuned->mean_speed_m_s;
  }

  std::string PlanResult::confirmation() const
  {
    if (!replay)
      return "not confirmed: the full-order model was not asked; say --replay";
    const double difference = std::abs(replay->gain() / gain() - 1.);
    return fmt::format("{}: {:.3g} times the tuned sinusoid on the full-order model, {:.3g} times on the reduced one",
                       difference <= confirming_difference ? "confirmed" : "not confirmed", replay->gain(), gain());
  }

  void write_plan_result(const std::filesystem::path &file, const PlanResult &result)
  {
    Json json            = to_json(result);
    json["gain"]         = to_json(result.gain());
    json["confirmation"] = result.confirmation();
    write_text_atomically(file, json.dump(2) + "\n");
  }

  PlanResult read_plan_result(const std::filesystem::path &file)
  {
    PlanResult result;
    try
    {
      from_json(Json::parse(read_text_file(file, "the plan")), result);
    }
    catch (const nlohmann::json::exception &problem)
    {
      throw InputError(
          fmt::format("{} is not a plan of swimtwin optimize ({}); run it again.", file.string(), problem.what()));
    }
    return result;
  }
} // namespace swimtwin
