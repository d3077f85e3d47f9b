#include <control/field/steering_limits.h>
#include <control/goal/goal_entries.h>
#include <control/goal/target_goal.h>
#include <datasets/system/error.h>
#include <datasets/text/text_decoding.h>
#include <rom/integration/swimmer_run.h>
#include <rom/swimmer/carried_inertia.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr std::array<std::pair<std::string_view, bool>, 1> kinds = {{{"target", true}}};

    /// The target's place in the swimmer's frame, x ahead and y to its left.
    Eigen::Vector2d read_target(const TomlDocument &document, TargetGoal &goal)
    {
      std::array<double, 2> position{};
      TargetOptions        &options = goal.options;
      TomlTable             table(document, "target");
      table.pair("position_m", {"m", any_number, Need::required}, position);
      table.number("distance", {"body lengths", positive}, options.distance);
      table.number("time_limit_s", {"s", positive}, options.time_limit_s);
      table.number("frequency_low_Hz", {"Hz", positive}, options.frequency_Hz.low);
      table.number("frequency_high_Hz", {"Hz", positive}, options.frequency_Hz.high);
      table.number("max_turn_rad", {"rad", positive}, options.max_turn_rad);
      table.number("sample_rate_Hz", {"Hz", positive}, goal.sample_rate_Hz);
      table.number("steps_per_second", {"1/s", positive}, goal.steps_per_second);
      table.finish();
      if (options.frequency_Hz.low > options.frequency_Hz.high)
        document.refuse("target", table.has("frequency_low_Hz") ? "frequency_low_Hz" : "frequency_high_Hz",
                        fmt::format("leaves no frequency: from {:.4g} to {:.4g} Hz (without an entry, as trained).",
                                    options.frequency_Hz.low, options.frequency_Hz.high));
      return {position[0], position[1]};
    }

    /// Beyond it a way is no plan but a mistake in the unit, and its search would not end.
    void require_reach(const TomlDocument &document, const TargetGoal &goal, const double body_length_m)
    {
      constexpr double farthest = 1e4; // body lengths
      const double     distance = (goal.target_m - goal.start.head<2>()).norm() / body_length_m;
      if (distance > farthest)
        document.refuse(
            "target", "position_m",
            fmt::format("is {:.3g} body lengths away; at most {:g} are possible: give it in m.", distance, farthest));
    }

    /// On the straight way from the start: neither a wall in between, nor one too near.
    void require_free_way(const TomlDocument &document, const TargetGoal &goal, const Scene &scene)
    {
      const Eigen::Vector2d way    = goal.target_m - goal.start.head<2>();
      const double          margin = head_margin_m(scene);
      const int             n      = static_cast<int>(std::ceil(2. * way.norm() / margin));
      for (int i = 1; i <= n; ++i)
        if (const Eigen::Vector2d point = goal.start.head<2>() + static_cast<double>(i) / n * way;
            !head_is_inside(scene, point))
          document.refuse(
              "target", "position_m",
              fmt::format("lies at ({:.4g}, {:.4g}) m: on the way there the head comes within {:.3g} m of a "
                          "wall, or through it, at ({:.4g}, {:.4g}) m; choose a nearer one, or use a model "
                          "without walls (open-2d).",
                          goal.target_m.x(), goal.target_m.y(), margin, point.x(), point.y()));
    }

    void require_known_heading(const TomlDocument &document, const TargetGoal &goal, const ReducedModel &model)
    {
      constexpr double small = 0.1; // rad
      const double     turn  = turn_towards(goal.target_m, goal.start);
      if (model.resistance.depends_on_angle && std::abs(turn) > small)
        document.refuse(
            "target", "position_m",
            fmt::format("asks for a turn by {:.3g} rad; the model {} was trained between walls and knows one "
                        "heading only; put the target straight ahead, or use a model whose domain moves with "
                        "the swimmer (open-2d).",
                        turn, model.scene_name));
    }

    /// The fastest turn at the highest frequency is within the limit on dB/dt.
    void keep_slew_rate(const TomlDocument &document, TargetGoal &goal)
    {
      const FieldLimits limits  = read_limits_of_turned_field(document, goal.carrier);
      TargetOptions    &options = goal.options;
      const double      slew    = largest_slew_T_per_period(goal.carrier, options.max_turn_rad / options.knot_periods);
      if (limits.slew_rate_T_s < slew * options.frequency_Hz.low)
        document.refuse("limits", "slew_rate_T_s",
                        fmt::format("is below the {:.4g} T/s of the turned carrier at the lowest frequency, {:.4g} Hz; "
                                    "raise it, or lower [carrier] by_T, [target] max_turn_rad or frequency_low_Hz.",
                                    slew * options.frequency_Hz.low, options.frequency_Hz.low));
      options.frequency_Hz.high = std::min(options.frequency_Hz.high, limits.slew_rate_T_s / slew);
    }

    /// What no steering makes up for: it gains a tenth where the target lies aside, by the turn itself.
    void require_time(const TomlDocument &document, const TargetGoal &goal, const ReducedSwimmer &swimmer)
    {
      constexpr double generous = 1.5;
      const double     distance = (goal.target_m - goal.start.head<2>()).norm();
      const double     near     = goal.options.distance * swimmer.length_m();
      if (distance <= near)
        document.refuse(
            "target", "position_m",
            fmt::format("is {:.3g} m from the head's centre, within [target] distance = {:.3g} body lengths "
                        "= {:.3g} m already; choose one farther away.",
                        distance, goal.options.distance, near));
      const StraightSwim swim = fastest_straight_swim(swimmer, goal.swimmer, goal.carrier, goal.options.frequency_Hz);
      if (const double time = (distance - near) / swim.speed_m_s(); time > generous * goal.options.time_limit_s)
        document.refuse(
            "target", "time_limit_s",
            fmt::format("is too short: straight on, the carrier swims {:.4g} m/s at most (at {:.4g} Hz), and "
                        "the target is {:.4g} s away; allow more time, or strengthen [carrier].",
                        swim.speed_m_s(), swim.frequency_Hz, time));
    }
  } // namespace

  TargetGoal read_target_goal(const std::filesystem::path &file, const ReducedModel &model, const std::string &inertia)
  {
    const Scene scene = scene_with_inertia(model, inertia);
    TargetGoal  goal;
    goal.text = read_decoded_text(file, "the goal");
    const TomlDocument document(goal.text, file.string(), {});
    TomlTable          top(document, "");
    bool               is_target = false;
    top.choice("kind", Need::required, kinds, is_target);
    for (const char *table : {"target", "carrier", "limits", "swimmer"})
      top.table(table);
    top.finish();
    goal.options.frequency_Hz = model.range.frequency_Hz;
    goal.carrier              = read_carrier(document, scene);
    goal.swimmer              = swimmer_parameters(scene);
    read_swimmer(document, "swimmer", goal.swimmer);
    if (!document.find("target"))
      document.refuse("target", "position_m", "is missing; give position_m = [x, y], x ahead and y to the left.");
    const Eigen::Vector2d place = read_target(document, goal);
    goal.inertia = carried_inertia(scene, model, extreme_of(goal.swimmer, goal.options.frequency_Hz.high));
    const ReducedSwimmer swimmer(model, inertial_densities(model, goal.inertia));
    goal.start = state_at_rest(swimmer, scene.head.angle_rad);
    goal.start.head<2>() << scene.head.center_m[0], scene.head.center_m[1];
    goal.target_m = goal.start.head<2>() + Eigen::Rotation2Dd(goal.start[2] + std::numbers::pi) * place;
    require_reach(document, goal, swimmer.length_m());
    require_free_way(document, goal, scene);
    require_known_heading(document, goal, model);
    keep_slew_rate(document, goal);
    require_time(document, goal, swimmer);
    return goal;
  }
} // namespace swimtwin
