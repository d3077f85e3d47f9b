#include <datasets/files/json_entries.h>
#include <datasets/run/plan_result.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  template <Like<PlanTraceStep> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("n_periods", v.n_periods);
    visit("objective", v.objective);
    visit("violation", v.violation);
    visit("n_evaluations", v.n_evaluations);
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
    visit("inertia", v.inertia);
    visit("heading_rad", v.heading_rad);
    visit("sample_rate_Hz", v.sample_rate_Hz);
    visit("fields", v.fields);
    visit("trade_off", v.trade_off);
    visit("members", v.members);
    visit("replay", v.replay);
    visit("refinement", v.refinement);
    visit("warnings", v.warnings);
    visit("search_time_s", v.search_time_s);
    visit("seed", v.seed);
    visit("goal_text", v.goal_text);
    visit("provenance", v.provenance);
  }

  double PlanReplay::largest_difference() const
  {
    double largest = 0.;
    for (const ReplayedField &field : fields)
    {
      const double difference = std::abs(field.reduced_displacement_m.back() / field.displacement_m.back() - 1.);
      if (std::isnan(difference))
        return difference;
      largest = std::max(largest, difference);
    }
    return largest;
  }

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
    Json json            = json_of(result);
    json["gain"]         = json_of(result.gain());
    json["confirmation"] = result.confirmation();
    write_json_file(file, json);
  }

  PlanResult read_plan_result(const std::filesystem::path &file)
  {
    Json json = read_json_file(file, "the plan", "run `swimtwin optimize` again");
    if (json.is_object())
      for (const char *entry : {"refinement", "inertia"})
        json.emplace(entry, Json::array()); // plans of earlier versions lack it: there was none
    PlanResult result;
    try
    {
      read_json(json, result);
      if (result.replay && result.replay->fields.size() != 2)
        throw InputError("has a replay of other than two fields");
    }
    catch (const InputError &problem)
    {
      throw InputError(
          fmt::format("{} is not a plan of swimtwin optimize ({}); run it again.", file.string(), problem.what()));
    }
    return result;
  }
} // namespace swimtwin
