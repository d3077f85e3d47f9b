// Verb track: a field that leads the swimmer along a path, planned ahead or decided in real time, or to a target.
#include <app/verbs/track.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/progress_bar.h>
#include <app/frame/shipped_files.h>
#include <app/frame/written_files.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/full_order_plant.h>
#include <app/full_order/model_refinement.h>
#include <app/trust/model_error.h>
#include <app/verbs/target.h>
#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <reports/page/draw_pictures.h>
#include <reports/plan/track_pictures.h>
#include <reports/sweep/model_card.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace swimtwin
{
  namespace
  {
    void require_whole_steps(const TrackingGoal &goal)
    {
      const double steps = goal.steps_per_second / goal.options.decisions_per_second;
      if (std::abs(steps - std::round(steps)) > 1e-9 || steps < 1.)
        throw InputError(fmt::format("[loop] steps_per_second = {} is not a whole number of steps per decision; take a "
                                     "multiple of decisions_per_second = {}.",
                                     goal.steps_per_second, goal.options.decisions_per_second));
    }

    std::unique_ptr<FullOrderPlant> full_order_plant(const ReducedModel &model, const TrackingGoal &goal,
                                                     const bool remembers_shapes)
    {
      require_whole_steps(goal);
      return make_full_order_plant(model,
                                   {goal.steps_per_second, goal.carrier.frequency_Hz, remembers_shapes, goal.inertia});
    }

    std::unique_ptr<Plant> make_plant(const ReducedModel &model, const ReducedSwimmer &swimmer,
                                      const TrackingGoal &goal)
    {
      if (goal.plant == PlantKind::full_order)
        return full_order_plant(model, goal, false);
      return std::make_unique<ReducedPlant>(swimmer, goal.true_parameters, state_at_rest(swimmer));
    }

    TrackResult swim(const ReducedModel &model, const ReducedSwimmer &swimmer, const TrackingGoal &goal)
    {
      if (goal.kind == TrackingKind::path)
        return follow_path(swimmer, goal.believed, goal.carrier, goal.path, goal.options);
      const auto plant = make_plant(model, swimmer, goal);
      return run_closed_loop(swimmer, goal.believed, goal.carrier, goal.path, *plant, goal.options);
    }

    std::string describe(const char *what, const TrackResult &r, const double length_m)
    {
      if (r.instants.empty())
        return fmt::format("  {:<18} {} before the first decision: {}\n", what, to_string(r.status), r.message);
      return fmt::format(
          "  {:<18} {} after {:.4g} s; mean position {:.2f} % of a body length off the path (rms), {:.2f} % "
          "at most; the head itself swings {:.1f} % (rms)\n",
          what, to_string(r.status), (r.end_periods - r.start_periods) / r.plan.carrier.frequency_Hz,
          100. * r.rms_distance_m / length_m, 100. * r.largest_distance_m / length_m, 100. * r.rms_swing_m / length_m);
    }

    std::string describe_swing(const TrackResult &r, const double length_m)
    {
      if (r.axis.empty())
        return "";
      const AxisPoint least = least_swinging(r.axis);
      return fmt::format(
          "  {:<18} the point {:.2g} mm behind the head's centre swings least: {:.1f} % of a body length "
          "(rms) about its own mean, {:.1f} % off the head's path\n",
          "", 1e3 * least.behind_m, 100. * least.rms_swing_m / length_m, 100. * least.rms_distance_m / length_m);
    }

    void print(const TrackRecord &record, const CommonOptions &common)
    {
      const TrackResult &r = record.result;
      say("{}", describe(record.goal.kind == TrackingKind::path ? "plan" : "closed loop", r, record.body_length_m));
      say_text(describe_swing(r, record.body_length_m));
      if (const auto &point = record.goal.options.point; point && !r.instants.empty())
        say("  {:<18} the led point, {:.2g} mm behind the head's centre, is {:.2f} % of a body length off its path "
            "at every instant (rms)\n",
            "", 1e3 * point->behind_m, 100. * r.rms_point_m / record.body_length_m);
      if (record.replay)
        say_text(describe("full-order replay", *record.replay, record.body_length_m));
      if (r.n_decisions > 0)
        say("  {} decisions: {:.2f} ms of CPU time on average, {:.2f} ms at most, {} too late\n", r.n_decisions,
            1e3 * r.mean_decision_s, 1e3 * r.largest_decision_s, r.n_missed);
      say("  results in {}\n", common.output.string());
    }

    void draw(const TrackCommand &command, const TrackRecord &record)
    {
      if (!command.no_picture && !record.result.instants.empty())
        draw_beside_results(command.common.output, track_pictures(record), command.common.command_line);
    }

    void write(const CommonOptions &common, const TrackRecord &record)
    {
      write_track_table(common.output / track_table_name, record.result);
      write_steered_field(common.output / track_field_name, record.result.plan, record.result.end_periods,
                          record.goal.sample_rate_Hz);
      if (record.replay)
        write_track_table(common.output / replay_table_name, *record.replay);
      write_track_summary(common.output / track_summary_name, record);
    }

    /// Plan or loop, and the replay of a plan if one is asked for.
    void track_with(const TrackCommand &command, const RefinedModel &by, TrackRecord &record)
    {
      const ReducedSwimmer swimmer(by.model, inertial_densities(by.model, record.goal.inertia));
      record.result        = swim(by.model, swimmer, record.goal);
      record.body_length_m = swimmer.length_m();
      record.model_file    = by.file.string();
      record.replay.reset();
      if (record.goal.kind != TrackingKind::path || !command.has_replay())
        return;
      const auto plant = full_order_plant(by.model, record.goal, command.refine.is_asked_for());
      record.replay    = play_plan(swimmer, record.goal.believed, record.result, *plant, record.goal.options);
      if (command.refine.is_asked_for())
        plant->write_snapshots(command.common.output / replay_snapshots_name);
    }

    void refine_and_track(const TrackCommand &command, const Refinement &refinement, RefinedModel &by,
                          TrackRecord &record)
    {
      ModelUse use;
      use.inertia    = record.goal.inertia;
      use.difference = [&] { return record.difference_of_replay(); };
      use.snapshots  = [&] { return std::vector{command.common.output / replay_snapshots_name}; };
      use.again      = [&](const RefinedModel &refined) {
        TrackRecord next = record;
        track_with(command, refined, next);
        if (!next.difference_of_replay())
          throw ComputationError("the path could not be planned or swum with it");
        record = std::move(next);
      };
      const RefinementReport report = refine_in_use(refinement, by, command.common, use);
      report.add_to(record); // to the last one
    }

    std::string doubt_of(const TrackCommand &command, const ReducedModel &model, const TrackingGoal &goal)
    {
      const InertiaDoubt doubt = doubt_inertia(scene_with_inertia(model, command.inertia.inertia), goal.inertia,
                                               extreme_of(goal.believed, goal.carrier.frequency_Hz));
      return accept_doubt(doubt, command.inertia.allowed,
                          "lower [carrier] frequency_Hz or raise [swimmer] viscosity_Pa_s");
    }

    void track_in_folder(const TrackCommand &command, const Refinement &refinement, RefinedModel by,
                         TrackRecord &record)
    {
      const CommonOptions &common = command.common;
      const Scene          scene  = parse_scene(by.model.scene_text, by.model.scene_name + ".toml");
      if (!common.quiet)
        say_text(model_card(by.model));
      const double start = wall_time_s();
      {
        ProgressBar bar(common.quiet);
        record.goal.options.on_progress = [&](const double share) {
          bar.show(static_cast<int>(1000. * share), 1000, static_cast<int>(1000. * share), wall_time_s() - start);
        };
        track_with(command, by, record);
        record.goal.options.on_progress = {};
      }
      if (command.refine.is_asked_for())
        refine_and_track(command, refinement, by, record);
      record.provenance = {current_program_version, common.command_line,  scene.text, scene.hash,
                           utc_time_now(),          wall_time_s() - start};
      write(common, record);
      draw(command, record);
      for (const std::string &warning : record.warnings)
        warn(warning);
      if (!common.quiet)
        print(record, common);
      if (record.result.status == TrackStatus::failed)
        throw ComputationError(record.result.message);
    }
  } // namespace

  void track_and_report(const TrackCommand &command)
  {
    const ReducedModel model = read_reduced_model(find_model(command.model));
    require_borne_model_error(model, command.model, command.accepts_model_error);
    const Refinement refinement(command.refine);
    TrackRecord      record;
    require_inertia(model, command.model, command.inertia.inertia);
    record.goal = read_tracking_goal(command.goal, model, command.inertia.inertia);
    if (const std::string doubt = doubt_of(command, model, record.goal); !doubt.empty())
      record.warnings.push_back(doubt);
    if (record.goal.plant == PlantKind::external)
      throw InputError(
          fmt::format("{}: [loop] plant = \"external\" is a laboratory, which is steered by what is seen of "
                      "it: run `swimtwin twin MODEL TWIN.toml` with [goal] file = \"{}\" in TWIN.toml.",
                      command.goal, std::filesystem::path(command.goal).filename().string()));
    if (command.refine.is_asked_for() && record.goal.kind != TrackingKind::path)
      throw InputError(fmt::format("{}: --refine is for plans, kind = \"path\" or \"target\": a closed loop corrects "
                                   "what its model does not know; leave --refine out.",
                                   command.goal));
    if (command.has_replay() && record.goal.kind == TrackingKind::path)
    {
      require_full_order_model(command.reason_for_replay(), RanksAtWork::this_one);
      require_whole_steps(record.goal);
    }
    if (record.goal.kind == TrackingKind::closed_loop && record.goal.plant == PlantKind::full_order)
      require_full_order_model("[loop] plant = \"full-order\"", RanksAtWork::this_one);
    const std::filesystem::path file = find_model(command.model);
    work_in_folder(output_request(command.common, written_by::optimize(), {file, command.goal}), [&](const Begun &) {
      track_in_folder(command, refinement, {model, file}, record);
    });
  }

  Work add_track(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<TrackCommand>();
    auto *verb =
        tool.add_subcommand("track", "Lead the swimmer along a path, planned ahead or in closed loop, or to a target");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")->required();
    verb->add_option("goal", command->goal, "Which path or target, which carrier, which plant (TOML)")->required();
    add_output_options(*verb, command->common, OutputFolder::required);
    verb->add_flag("--replay", command->with_replay,
                   "Play the plan of a path or to a target blindly on the full-order model too");
    add_refine_options(*verb, command->refine);
    add_inertia_options(*verb, command->inertia);
    verb->add_flag("--no-picture", command->no_picture, "Draw nothing");
    verb->add_flag(accept_model_error, command->accepts_model_error, accept_model_error_help);
    command->common.command_line = command_line;
    return [command] {
      if (!is_speaker())
        return;
      if (is_target_goal(command->goal))
        reach_and_report(*command);
      else
        track_and_report(*command);
    };
  }
} // namespace swimtwin
