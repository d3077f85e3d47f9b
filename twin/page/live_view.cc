#include <datasets/files/json_entries.h>
#include <twin/page/live_view.h>

namespace swimtwin
{
  std::string view_line(const SwimmerTwin &twin, const TailAxis &axis, const EstimateRecord &r)
  {
    constexpr int            n_points = 16;
    const Eigen::VectorXd   &mean     = r.belief.mean;
    const Eigen::Rotation2Dd turned(mean[2]);
    Json                     json = {{"type", "view"}, {"time_s", r.time_s}};
    json["x_m"]                   = mean[0];
    json["y_m"]                   = mean[1];
    json["angle_rad"]             = mean[2];
    json["sd_m"]                  = std::max(r.belief.standard_deviation(0), r.belief.standard_deviation(1));
    json["axis_m"]                = Json::array({{mean[0], mean[1]}});
    for (int i = 0; i <= n_points; ++i)
    {
      const ShapeVector     q = mean.segment(3, twin.swimmer().n_modes());
      const Eigen::Vector2d p = mean.head<2>() + turned * axis.position_m(static_cast<double>(i) / n_points, q);
      json["axis_m"].push_back({p.x(), p.y()});
    }
    json["parameters"] = Json::object();
    for (const NamedParameter &p : named_parameters(twin, r.belief))
      json["parameters"][p.name] = {p.value, p.standard_deviation};
    const Eigen::Vector2d field_T = twin.field().value_T(r.time_s);
    json["field_T"]               = {field_T.x(), field_T.y()};
    json["trust"]                 = r.trust;
    json["flags"]                 = r.flags;
    return json.dump();
  }
} // namespace swimtwin
