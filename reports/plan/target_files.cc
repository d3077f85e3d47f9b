#include <reports/plan/target_files.h>

#include <datasets/scene/inertia_terms.h>
#include <datasets/text/csv_writer.h>
#include <reports/plan/track_files.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    constexpr int instants_per_period = 20;
  }

  std::string TargetRecord::message() const
  {
    if (way.n_periods == 0)
      return "no number of periods that reaches so far ends within [target] time_limit_s";
    if (way.found())
      return way.minimum.message;
    return fmt::format("the head's centre comes no nearer than {:.3g} m within {} periods: {}",
                       (way.end_m - goal.target_m).norm(), way.n_periods, way.minimum.message);
  }

  std::optional<double> TargetRecord::difference_of_replay() const
  {
    if (!replay)
      return {};
    const Eigen::Vector2d start = swim.front().pose.position_m, end = swim.back().pose.position_m;
    return (end - replay->back().pose.position_m).norm() / (end - start).norm();
  }

  std::vector<TargetInstant> swim_to_target(Plant &plant, const SteeringPlan &plan, const int n_periods,
                                            const Eigen::Vector2d &target_m)
  {
    std::vector<TargetInstant> swim;
    const auto                 look = [&](const double periods) {
      const Pose pose = plant.pose();
      swim.push_back(
                          {periods / plan.carrier.frequency_Hz, pose, (pose.position_m - target_m).norm(), plan.field_T(periods)});
    };
    look(0.);
    for (int i = 1; i <= n_periods * instants_per_period; ++i)
    {
      const double now = static_cast<double>(i) / instants_per_period;
      plant.advance(plan, static_cast<double>(i - 1) / instants_per_period, now);
      look(now);
    }
    return swim;
  }

  void write_swim_table(const std::filesystem::path &file, const std::vector<TargetInstant> &swim)
  {
    using Row                                              = const TargetInstant &;
    static const std::vector<CsvColumn<TargetInstant>> all = {
        {"time_s", [](Row r) { return r.time_s; }},
        {"head_x_m", [](Row r) { return r.pose.position_m.x(); }},
        {"head_y_m", [](Row r) { return r.pose.position_m.y(); }},
        {"head_angle_rad", [](Row r) { return r.pose.angle_rad; }},
        {"distance_m", [](Row r) { return r.distance_m; }},
        {"bx_T", [](Row r) { return r.field_T.x(); }},
        {"by_T", [](Row r) { return r.field_T.y(); }}};
    csv_table(all, swim).save(file);
  }

  void write_target_summary(const std::filesystem::path &file, const TargetRecord &record)
  {
    const TargetWay &way = record.way;
    Json             json;
    json["kind"]            = "target";
    json["status"]          = record.status();
    json["message"]         = record.message();
    json["target_m"]        = {record.goal.target_m.x(), record.goal.target_m.y()};
    json["straight_time_s"] = way.straight_time_s;
    if (way.n_periods > 0)
    {
      json["duration_s"]                = way.time_s;
      json["n_periods"]                 = way.n_periods;
      json["frequency_Hz"]              = way.plan.carrier.frequency_Hz;
      json["end_distance_body_lengths"] = (way.end_m - record.goal.target_m).norm() / record.body_length_m;
      json["search_status"]             = to_string(way.minimum.status);
      json["first_order_residual"]      = way.minimum.kkt_residual;
      json["n_evaluations"]             = way.minimum.n_evaluations;
      json["largest_field_T"]           = way.plan.largest_field_T();
    }
    json["body_length_m"] = record.body_length_m;
    json["inertia"]       = names_of(record.goal.inertia);
    if (record.replay)
      json["replay"] = {{"end_distance_body_lengths", record.replay->back().distance_m / record.body_length_m}};
    else
      json["replay"] = "not confirmed";
    write_summary(file, std::move(json), record);
  }
} // namespace swimtwin
