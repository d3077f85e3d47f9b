#include <app/verbs/target.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/shipped_files.h>
#include <app/frame/written_files.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/full_order_plant.h>
#include <app/full_order/model_refinement.h>
#include <app/trust/model_error.h>
#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <reports/page/draw_pictures.h>
#include <reports/plan/target_pictures.h>
#include <reports/plan/track_files.h>
#include <reports/sweep/model_card.h>
#include <rom/integration/swimmer_integrator.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    void add_swim(const ReducedSwimmer &swimmer, TargetRecord &record)
    {
      const TargetGoal &goal = record.goal;
      const int         n    = record.way.n_periods;
      ReducedPlant      plant(swimmer, goal.swimmer, goal.start);
      record.swim = swim_to_target(plant, record.way.plan, n, goal.target_m);
      SwimmerIntegrator integrator(swimmer, {.max_step_periods = IntegratorOptions().max_step_periods / n});
      const SwimmerRun  run = integrator.run({goal.swimmer, window_of(record.way.plan, 0., n), goal.start, 1, 0});
      if (run.largest_shape_radius > 1.)
        record.warnings.push_back(fmt::format(
            "the tail bends {:.3g} times as far as the model was trained for; say --replay to know how near "
            "the swimmer comes",
            run.largest_shape_radius));
    }

    void add_replay(const TrackCommand &command, const ReducedModel &model, TargetRecord &record)
    {
      const auto plant =
          make_full_order_plant(model, {record.goal.steps_per_second, record.way.plan.carrier.frequency_Hz,
                                        command.refine.is_asked_for(), record.goal.inertia});
      record.replay = swim_to_target(*plant, record.way.plan, record.way.n_periods, record.goal.target_m);
      if (command.refine.is_asked_for())
        plant->write_snapshots(command.common.output / replay_snapshots_name);
    }

    /// At the frequency that was found.
    InertiaDoubt doubt_of(const TrackCommand &command, const ReducedModel &model, const TargetRecord &record)
    {
      return doubt_inertia(scene_with_inertia(model, command.inertia.inertia), record.goal.inertia,
                           extreme_of(record.goal.swimmer, record.way.plan.carrier.frequency_Hz));
    }

    void reach_with(const TrackCommand &command, const RefinedModel &by, TargetRecord &record)
    {
      const ReducedSwimmer swimmer(by.model, inertial_densities(by.model, record.goal.inertia));
      record.way        = fastest_way(swimmer, record.goal.swimmer, record.goal.carrier, record.goal.start,
                                      record.goal.target_m, record.goal.options);
      record.model_file = by.file.string();
      record.warnings.clear();
      record.swim.clear();
      record.replay.reset();
      if (!record.way.found())
        return;
      if (const InertiaDoubt doubt = doubt_of(command, by.model, record); !doubt.finding.empty())
        record.warnings.push_back(doubt.warning());
      add_swim(swimmer, record);
      if (command.has_replay())
        add_replay(command, by.model, record);
    }

    void refine_and_reach(const TrackCommand &command, const Refinement &refinement, RefinedModel &by,
                          TargetRecord &record)
    {
      ModelUse use;
      use.inertia    = record.goal.inertia;
      use.difference = [&] { return record.difference_of_replay(); };
      use.snapshots  = [&] { return std::vector{command.common.output / replay_snapshots_name}; };
      use.again      = [&](const RefinedModel &refined) {
        TargetRecord next = record;
        reach_with(command, refined, next);
        if (!next.replay)
          throw ComputationError(next.message());
        record = std::move(next);
      };
      const RefinementReport report = refine_in_use(refinement, by, command.common, use);
      report.add_to(record); // to the last one
    }

    void write(const TrackCommand &command, const TargetRecord &record)
    {
      const std::filesystem::path folder = command.common.output;
      if (!record.swim.empty())
      {
        write_swim_table(folder / track_table_name, record.swim);
        write_steered_field(folder / track_field_name, record.way.plan, record.way.n_periods,
                            record.goal.sample_rate_Hz);
      }
      if (record.replay)
        write_swim_table(folder / replay_table_name, *record.replay);
      write_target_summary(folder / track_summary_name, record);
      if (!command.no_picture && !record.swim.empty())
        draw_beside_results(folder, target_pictures(record), command.common.command_line);
    }

    void print(const TargetRecord &record, const CommonOptions &common)
    {
      const auto share = [&](const double distance_m) { return 100. * distance_m / record.body_length_m; };
      say("  {} after {:.4g} s, {} periods at {:.4g} Hz; the head's centre ends {:.2f} % of a body length from the "
          "target\n  straight on and not turned, the carrier takes {:.4g} s; search: {}, {}\n",
          record.status(), record.way.time_s, record.way.n_periods, record.way.plan.carrier.frequency_Hz,
          share(record.swim.back().distance_m), record.way.straight_time_s, to_string(record.way.minimum.status),
          record.message());
      if (record.replay)
        say("  full-order replay  ends {:.2f} % of a body length from the target\n",
            share(record.replay->back().distance_m));
      say("  results in {}\n", common.output.string());
    }

    void reach_in_folder(const TrackCommand &command, const Refinement &refinement, RefinedModel by,
                         TargetRecord &record)
    {
      const CommonOptions &common = command.common;
      const Scene          scene  = parse_scene(by.model.scene_text, by.model.scene_name + ".toml");
      if (!common.quiet)
        say_text(model_card(by.model));
      const double start = wall_time_s();
      reach_with(command, by, record);
      if (command.refine.is_asked_for())
        refine_and_reach(command, refinement, by, record);
      record.provenance = {current_program_version, common.command_line,  scene.text, scene.hash,
                           utc_time_now(),          wall_time_s() - start};
      write(command, record);
      const InertiaDoubt doubt = record.way.found() ? doubt_of(command, by.model, record) : InertiaDoubt();
      warn_of(record.warnings, doubt, command.inertia.allowed);
      if (!record.way.found())
        throw InputError(
            fmt::format("{}: the target is infeasible: {}; allow more time or a wider [target] distance, or "
                        "choose a nearer one.",
                        command.goal, record.message()));
      if (!common.quiet)
        print(record, common);
      if (doubt.refuses(command.inertia.allowed))
        throw ComputationError(doubt.refusal("lower [target] frequency_high_Hz or raise [swimmer] viscosity_Pa_s"));
    }
  } // namespace

  void reach_and_report(const TrackCommand &command)
  {
    const ReducedModel model = read_reduced_model(find_model(command.model));
    require_borne_model_error(model, command.model, command.accepts_model_error);
    const Refinement refinement(command.refine);
    TargetRecord     record;
    require_inertia(model, command.model, command.inertia.inertia);
    record.goal          = read_target_goal(command.goal, model, command.inertia.inertia);
    record.body_length_m = ReducedSwimmer(model).length_m();
    if (command.has_replay())
      require_full_order_model(command.reason_for_replay(), RanksAtWork::this_one);
    const std::filesystem::path file = find_model(command.model);
    work_in_folder(output_request(command.common, written_by::optimize(), {file, command.goal}), [&](const Begun &) {
      reach_in_folder(command, refinement, {model, file}, record);
    });
  }
} // namespace swimtwin
