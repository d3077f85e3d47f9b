#include <reports/plan/track_files.h>

#include <datasets/scene/field_program_writer.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/text/csv_writer.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    const std::vector<CsvColumn<TrackedInstant>> &columns()
    {
      using Row                                               = const TrackedInstant &;
      static const std::vector<CsvColumn<TrackedInstant>> all = {
          {"time_s", [](Row r) { return r.time_s; }},
          {"head_x_m", [](Row r) { return r.pose.position_m.x(); }},
          {"head_y_m", [](Row r) { return r.pose.position_m.y(); }},
          {"head_angle_rad", [](Row r) { return r.pose.angle_rad; }},
          {"mean_x_m", [](Row r) { return r.mean_m.x(); }},
          {"mean_y_m", [](Row r) { return r.mean_m.y(); }},
          {"path_x_m", [](Row r) { return r.path_m.x(); }},
          {"path_y_m", [](Row r) { return r.path_m.y(); }},
          {"arc_m", [](Row r) { return r.arc_m; }},
          {"distance_m", [](Row r) { return r.distance_m; }},
          {"heading_error_rad", [](Row r) { return r.heading_error_rad; }},
          {"measured_x_m", [](Row r) { return r.measured.position_m.x(); }},
          {"measured_y_m", [](Row r) { return r.measured.position_m.y(); }},
          {"measured_angle_rad", [](Row r) { return r.measured.angle_rad; }},
          {"estimated_x_m", [](Row r) { return r.estimated.position_m.x(); }},
          {"estimated_y_m", [](Row r) { return r.estimated.position_m.y(); }},
          {"estimated_angle_rad", [](Row r) { return r.estimated.angle_rad; }},
          {"bx_T", [](Row r) { return r.field_T.x(); }},
          {"by_T", [](Row r) { return r.field_T.y(); }},
          {"decision_cpu_s", [](Row r) { return r.decision_cpu_s; }},
          {"decided_in_time", [](Row r) { return r.decided ? 1. : 0.; }},
      };
      return all;
    }

    Json axis_points(const std::vector<AxisPoint> &points, const double length_m)
    {
      Json json = Json::array();
      for (const AxisPoint &point : points)
        json.push_back({{"behind_head_body_lengths", point.behind_m / length_m},
                        {"rms_distance_body_lengths", point.rms_distance_m / length_m},
                        {"rms_swing_body_lengths", point.rms_swing_m / length_m}});
      return json;
    }

    /// null for what was not computed: means over no decisions, a point that was not asked for.
    Json numbers_of(const TrackResult &result, const TrackRecord &record)
    {
      const double length_m = record.body_length_m;
      const double f        = result.plan.carrier.frequency_Hz;
      const auto   mean     = [&](const double value) { return result.instants.empty() ? Json() : Json(value); };
      Json         json;
      json["status"]                         = to_string(result.status);
      json["message"]                        = result.message;
      json["duration_s"]                     = (result.end_periods - result.start_periods) / f;
      json["rms_distance_body_lengths"]      = mean(result.rms_distance_m / length_m);
      json["largest_distance_body_lengths"]  = mean(result.largest_distance_m / length_m);
      json["rms_swing_of_head_body_lengths"] = mean(result.rms_swing_m / length_m);
      json["rms_heading_error_rad"]          = mean(result.rms_heading_rad);
      json["rms_distance_of_point_body_lengths"] =
          record.goal.options.point ? mean(result.rms_point_m / length_m) : Json();
      json["axis_points"]            = axis_points(result.axis, length_m);
      json["n_decisions"]            = result.n_decisions;
      json["n_missed_deadlines"]     = result.n_missed;
      json["mean_decision_cpu_s"]    = mean(result.mean_decision_s);
      json["largest_decision_cpu_s"] = mean(result.largest_decision_s);
      return json;
    }
  } // namespace

  std::optional<double> TrackRecord::difference_of_replay() const
  {
    const auto is_usable = [](const TrackResult &track) {
      return track.status != TrackStatus::failed && !track.instants.empty();
    };
    if (!replay || !is_usable(result) || !is_usable(*replay))
      return {};
    const TrackedInstant &planned = result.instants.back(), &replayed = replay->instants.back();
    const double          way_m = planned.arc_m - result.instants.front().arc_m;
    return way_m > 0. ? std::optional((planned.mean_m - replayed.mean_m).norm() / way_m) : std::nullopt;
  }

  void write_track_table(const std::filesystem::path &file, const TrackResult &result)
  {
    csv_table(columns(), result.instants).save(file);
  }

  void write_steered_field(const std::filesystem::path &file, const SteeringPlan &plan, const double n_periods,
                           const double sample_rate_Hz)
  {
    const double                       f = plan.carrier.frequency_Hz, end_s = n_periods / f;
    std::vector<double>                time_s;
    std::vector<std::array<double, 3>> b_T;
    for (long i = 0; static_cast<double>(i) / sample_rate_Hz < end_s - 1e-9; ++i)
    {
      time_s.push_back(static_cast<double>(i) / sample_rate_Hz);
      const Eigen::Vector2d b = plan.field_T(time_s.back() * f);
      b_T.push_back({b.x(), b.y(), 0.});
    }
    write_field_samples(file, {time_s, b_T, end_s}, "played once, from rest");
  }

  void write_track_summary(const std::filesystem::path &file, const TrackRecord &record)
  {
    const TrackResult &result = record.result;
    Json               json   = numbers_of(result, record);
    json["kind"]              = to_string(record.goal.kind);
    json["plant"]         = record.goal.kind == TrackingKind::path ? "the model itself" : to_string(record.goal.plant);
    json["path_length_m"] = result.path.length_m();
    json["body_length_m"] = record.body_length_m;
    json["advance_per_period_m"] = result.advance_m;
    json["lever_m"]              = result.lever_m;
    json["largest_field_T"]      = result.plan.largest_field_T();
    json["inertia"]              = names_of(record.goal.inertia);
    if (record.replay)
      json["replay"] = numbers_of(*record.replay, record);
    else if (record.goal.kind == TrackingKind::path)
      json["replay"] = "not confirmed";
    write_summary(file, std::move(json), record);
  }
} // namespace swimtwin
