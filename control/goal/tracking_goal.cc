#include <control/field/steering_limits.h>
#include <control/goal/goal_entries.h>
#include <control/goal/tracking_goal.h>
#include <datasets/system/error.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>
#include <rom/swimmer/carried_inertia.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using namespace std::string_literals;

    enum class PathShape { line, circle, square, figure_eight, waypoints };
    constexpr std::array<std::pair<std::string_view, PathShape>, 5> shapes = {
        {{"line", PathShape::line},
         {"circle", PathShape::circle},
         {"square", PathShape::square},
         {"figure-eight", PathShape::figure_eight},
         {"waypoints", PathShape::waypoints}}};
    constexpr std::array<std::pair<std::string_view, TrackingKind>, 3> tracking_kinds = {
        {{"path", TrackingKind::path}, {"closed-loop", TrackingKind::closed_loop}, {"target", TrackingKind::target}}};
    constexpr std::array<std::pair<std::string_view, PlantKind>, 3> plants = {
        {{"reduced", PlantKind::reduced}, {"full-order", PlantKind::full_order}, {"external", PlantKind::external}}};
    constexpr Range share{0., 1., true, false, "be above 0 and at most 1"};

    std::vector<Eigen::Vector2d> read_waypoints(TomlTable &table)
    {
      std::vector<Eigen::Vector2d> points = {Eigen::Vector2d::Zero()};
      for (std::string key = "waypoint_1_m"; table.has(key); key = fmt::format("waypoint_{}_m", points.size()))
      {
        std::array<double, 2> point{};
        table.pair(key, {"m", any_number}, point);
        points.emplace_back(point[0], point[1]);
      }
      return points;
    }

    /// `behind`: the point that is to be on the path, body lengths behind the head's centre.
    Path read_path(const TomlDocument &document, double &behind)
    {
      TomlTable             table(document, "path");
      PathShape             shape = PathShape::line;
      std::optional<double> size, part;
      table.choice("shape", Need::required, shapes, shape);
      table.number("size_m", {"m", positive, shape == PathShape::waypoints ? Need::optional : Need::required}, size);
      table.number("length_m", {"m", positive}, part);
      table.number("point_behind", {"body lengths", not_negative}, behind);
      const std::vector<Eigen::Vector2d> points = read_waypoints(table);
      table.finish();
      if (shape == PathShape::waypoints && points.size() < 2)
        document.refuse("path", "waypoint_1_m", "is missing; give waypoint_1_m = [x, y], waypoint_2_m and so on.");
      const Path whole = shape == PathShape::line           ? Path::line(*size)
                         : shape == PathShape::circle       ? Path::circle(*size)
                         : shape == PathShape::square       ? Path::square(*size)
                         : shape == PathShape::figure_eight ? Path::figure_eight(*size)
                                                            : Path::through(points);
      return part ? whole.first(*part) : whole;
    }

    void read_follower(const TomlDocument &document, FollowerOptions &options)
    {
      constexpr Range horizon{1., 10., false, false, "be 1 to 10 periods"};
      TomlTable       table(document, "follower");
      table.number("horizon_periods", {"", horizon}, options.horizon_periods);
      table.number("distance_scale", {"body lengths", positive}, options.distance_scale);
      table.number("progress_scale", {"body lengths", positive}, options.progress_scale);
      table.number("heading_scale_rad", {"rad", not_negative}, options.heading_scale_rad);
      table.number("turn_scale_rad", {"rad", positive}, options.turn_scale_rad);
      table.number("max_turn_rad", {"rad", positive}, options.max_turn_rad);
      table.finish();
    }

    void read_loop(const TomlDocument &document, TrackingGoal &goal)
    {
      ClosedLoopOptions &options = goal.options;
      int                seed    = static_cast<int>(options.seed);
      TomlTable          table(document, "loop");
      table.number("decisions_per_second", {"1/s", positive}, options.decisions_per_second);
      table.number("deadline_s", {"s", not_negative}, options.deadline_s);
      table.number("position_noise", {"body lengths", not_negative}, options.position_noise);
      table.number("angle_noise_rad", {"rad", not_negative}, options.angle_noise_rad);
      table.number("position_gain", {"", share}, options.position_gain);
      table.number("angle_gain", {"", share}, options.angle_gain);
      table.number("delay_s", {"s", not_negative}, options.delay_s);
      table.number("warm_up_periods", {"", not_negative}, options.warm_up_periods);
      table.number("max_periods", {"", positive}, options.max_periods);
      table.integer("seed", {"", not_negative}, seed);
      table.number("sample_rate_Hz", {"Hz", positive}, goal.sample_rate_Hz);
      table.number("steps_per_second", {"1/s", positive}, goal.steps_per_second);
      table.choice("plant", Need::optional, plants, goal.plant);
      table.finish();
      options.seed = static_cast<unsigned int>(seed);
    }

    /// Of a swimmer in a laboratory the twin knows what a goal would state of it.
    void require_external_loop(const TomlDocument &document, const TrackingGoal &goal)
    {
      if (goal.kind != TrackingKind::closed_loop)
        document.refuse("loop", "plant",
                        "is for kind = \"closed-loop\": a laboratory is steered by what is seen; change kind.");
      for (const char *table : {"swimmer", "plant"})
        if (document.find(table) != nullptr)
          document.refuse("loop", "plant",
                          fmt::format("has no [{}]: the twin estimates the swimmer; leave [{}] out, and state what is "
                                      "known in TWIN.toml.",
                                      table, table));
      for (const char *key : {"position_noise", "angle_noise_rad", "position_gain", "angle_gain", "delay_s"})
        if (document.find(std::string("loop.") + key) != nullptr)
          document.refuse("loop", key,
                          "is of an imagined plant; leave it out with plant = \"external\": the twin has its own "
                          "camera and observer.");
    }

    /// The head goes before the point, whose path begins behind the head's then.
    void lead_point(const TomlDocument &document, const double behind_m, TrackingGoal &goal)
    {
      const Path wanted = goal.path;
      try
      {
        goal.path = wanted.of_front(behind_m);
      }
      catch (const InputError &error)
      {
        document.refuse("path", "point_behind", std::string(": ") + error.what());
      }
      goal.options.point = LedPoint{behind_m, wanted.placed(0., {-behind_m, 0.})};
    }

    /// Turns no faster than the limit on dB/dt leaves to the carrier.
    void keep_slew_rate(const TomlDocument &document, TrackingGoal &goal)
    {
      FieldLimits &limits = goal.limits;
      if (!std::isfinite(limits.slew_rate_T_s))
        return;
      double      &turn = goal.options.follower.max_turn_rad;
      const double knot = SteeringPlan().knot_periods;
      const double rate = largest_turn_rate(goal.carrier, limits.slew_rate_T_s, turn / knot);
      if (rate <= 0.)
        document.refuse("limits", "slew_rate_T_s",
                        fmt::format("leaves no turn to a carrier that changes by {:.4g} T/s itself; raise it, or lower "
                                    "[carrier] frequency_Hz or by_T.",
                                    largest_slew_T_per_period(goal.carrier, 0.) * goal.carrier.frequency_Hz));
      turn = rate * knot;
    }

    /// Along every piece of the path, not at its corners alone: a path must not lead through a wall.
    void require_inside(const TomlDocument &document, const Path &path, const Scene &scene)
    {
      const Path placed =
          path.placed(scene.head.angle_rad + std::numbers::pi, {scene.head.center_m[0], scene.head.center_m[1]});
      const double margin = head_margin_m(scene), step = 0.5 * margin;
      for (double arc = 0.; arc <= placed.length_m() + step; arc += step)
        if (const Eigen::Vector2d point = placed.at(arc).point_m; !head_is_inside(scene, point))
          document.refuse("path", "shape",
                          fmt::format("leads the head within {:.3g} m of a wall, or through it, at ({:.4g}, {:.4g}) m, "
                                      "{:.4g} m after its start; shorten or move the path, or use a model without "
                                      "walls (open-2d).",
                                      margin, point.x(), point.y(), std::min(arc, placed.length_m())));
    }
  } // namespace

  std::string to_string(const TrackingKind kind)
  {
    return kind == TrackingKind::path ? "path" : kind == TrackingKind::target ? "target" : "closed-loop";
  }

  std::string to_string(const PlantKind kind)
  {
    return kind == PlantKind::reduced ? "reduced" : kind == PlantKind::full_order ? "full-order" : "external";
  }

  bool is_target_goal(const std::filesystem::path &file)
  {
    const TomlDocument document(read_decoded_text(file, "the goal"), file.string(), {});
    const toml::node  *kind = document.find("kind");
    return kind && kind->value<std::string>() == "target";
  }

  TrackingGoal read_tracking_goal(const std::filesystem::path &file, const ReducedModel &model,
                                  const std::string &inertia)
  {
    const Scene  scene = scene_with_inertia(model, inertia);
    TrackingGoal goal;
    goal.text = read_decoded_text(file, "the goal");
    const TomlDocument document(goal.text, file.string(), {});
    TomlTable          top(document, "");
    top.choice("kind", Need::required, tracking_kinds, goal.kind);
    for (const char *table : {"path", "carrier", "limits", "follower", "loop", "swimmer", "plant"})
      top.table(table);
    top.finish();
    double behind           = 0.;
    goal.path               = read_path(document, behind);
    double bound_T          = FieldLimits::none;
    goal.carrier            = read_carrier(document, scene, &bound_T);
    goal.limits             = read_limits_of_turned_field(document, goal.carrier);
    goal.limits.magnitude_T = std::min(goal.limits.magnitude_T, bound_T);
    goal.believed           = swimmer_parameters(scene);
    read_swimmer(document, "swimmer", goal.believed);
    goal.true_parameters = goal.believed;
    read_swimmer(document, "plant", goal.true_parameters);
    read_follower(document, goal.options.follower);
    read_loop(document, goal);
    if (goal.plant == PlantKind::external)
      require_external_loop(document, goal);
    keep_slew_rate(document, goal);
    goal.inertia = carried_inertia(scene, model, extreme_of(goal.believed, goal.carrier.frequency_Hz));
    const ReducedSwimmer swimmer(model, inertial_densities(model, goal.inertia));
    if (behind > 0.)
      lead_point(document, behind * swimmer.length_m(), goal);
    require_inside(document, goal.path, scene);
    require_followable(goal.path, carrier_motion(swimmer, goal.believed, goal.carrier).lever_m);
    return goal;
  }
} // namespace swimtwin
