// Verb reconstruct: one run of a reduced swimmer with the whole tail and, where this build has it, the flow.
#include <app/frame/claimed_folder.h>
#include <app/frame/progress_bar.h>
#include <app/frame/shipped_files.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <app/full_order/flow_output.h>
#include <app/full_order/full_order_build.h>
#include <app/trust/carried_inertia.h>
#include <app/trust/model_error.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <reports/run/draw_run.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/sweep/reconstruction.h>
#include <rom/sweep/starting_state.h>
#include <rom/sweep/sweep.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace swimtwin
{
  namespace
  {
    struct ReconstructCommand
    {
      CommonOptions common;
      std::string   model;
      int           n_instants         = 24;
      double        relative_tolerance = IntegratorOptions().relative_tolerance;
      InertiaChoice inertia;
      bool          with_flow = false, with_pictures = false;
    };

    /// A reduced model knows one body in one domain: what else a scene says may not be changed.
    void require_known_to_model(const std::vector<std::string> &overrides)
    {
      const std::vector<std::string> free = {
          "tail.young_modulus_Pa=",  "fluid.viscosity_Pa_s=", "head.magnetization_A_m=",
          "tail.magnetization_A_m=", "time.periods=",         "field."};
      for (const std::string &override_text : overrides)
        if (std::none_of(free.begin(), free.end(),
                         [&](const std::string &start) { return override_text.starts_with(start); }))
          throw InputError(fmt::format(
              "--set {} changes what the reduced model was trained for: only young_modulus_Pa, viscosity_Pa_s, "
              "magnetization_A_m, [field] and time.periods can be set (inertia by --inertia); train another model",
              override_text));
    }

    Scene scene_of_run(const ReconstructCommand &command, const ReducedModel &model)
    {
      require_known_to_model(command.common.overrides);
      std::vector<std::string> overrides = command.common.overrides;
      if (!command.inertia.inertia.empty())
        overrides.push_back("fluid.inertia=" + command.inertia.inertia);
      return parse_scene(model.scene_text, model.scene_name + ".toml", overrides);
    }

    int n_periods(const Scene &scene)
    {
      const double n = std::round(scene.time.periods);
      if (std::abs(scene.time.periods - n) > 1e-9)
        throw InputError(
            fmt::format("time.periods = {} is not possible here: a reduced run takes a whole number of periods",
                        scene.time.periods));
      return static_cast<int>(n);
    }

    /// A run of a reduced model, before anything is written.
    struct ReducedRun
    {
      const ReducedModel &model;
      Scene               scene;
      RunRequest          request;
      InertiaTerms        inertia; ///< that is carried
      std::string         doubt;   ///< about it; may be empty
    };

    InertialExtreme extreme_of(const ReducedRun &run)
    {
      return extreme_of(run.request.parameters, run.request.drive.frequency_Hz);
    }

    InertiaRecord inertia_record(const ReducedRun &run)
    {
      const InertiaShares shares      = extreme_of(run).shares(run.scene);
      const bool          is_left_out = run.scene.fluid->inertia == Inertia::automatic && !run.inertia.any();
      return {names_of(run.inertia), shares.fluid, shares.tail, shares.head, is_left_out ? shares.together() : 0.};
    }

    SwimmerRun motion_of(const ReducedRun &run, const double relative_tolerance)
    {
      const ReducedSwimmer swimmer(run.model, inertial_densities(run.model, run.inertia));
      RunRequest           request = run.request;
      request.initial_state        = starting_state(swimmer, request.initial_state);
      SwimmerRun motion = SwimmerIntegrator(swimmer, {.relative_tolerance = relative_tolerance}).run(request);
      if (!motion.completed())
        throw ComputationError(motion.failure);
      return motion;
    }

    RunSummary summary_of(const ReducedRun &run, const SwimmerRun &motion)
    {
      RunSummary summary;
      summary.status = "completed";
      summarize_motion(motion.trajectory, run.scene.time.period_s, run.scene.head.angle_rad, summary);
      summary.n_unknowns = static_cast<int>(motion.at_period_end.front().size());
      summary.n_steps    = static_cast<int>(motion.n_steps);
      summary.inertia    = inertia_record(run);
      if (const TrustNotes trust = trust_notes(run.model.range, run.request, motion); !trust.inside())
        summary.warnings.push_back("outside what the model was trained for: " + trust.text());
      if (!run.doubt.empty())
        summary.warnings.push_back(run.doubt);
      return summary;
    }

    std::vector<PlaneFlow> write_flow_with_progress(const ReconstructCommand &command, const ReducedRun &run,
                                                    const std::vector<ReducedSnapshot> &snapshots)
    {
      const auto  start = std::chrono::steady_clock::now();
      const int   n     = static_cast<int>(snapshots.size());
      ProgressBar bar(command.common.quiet);
      return write_flow_of_run(run.scene, run.model, run.request, snapshots, command.common.output / "fields",
                               [&](const int n_done) {
                                 const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - start;
                                 bar.show(n_done, n, n_done, so_far.count());
                               });
    }

    void reconstruct_in_folder(const ReconstructCommand &command, const ReducedRun &run)
    {
      const auto &[model, scene, request, inertia, doubt] = run;
      const CommonOptions &common                         = command.common;
      const SwimmerRun     motion                         = motion_of(run, command.relative_tolerance);
      const RunSummary     summary                        = summary_of(run, motion);
      const SnapshotSet    shapes                         = reconstruct(model.tail, request.drive, motion.snapshots);
      const Provenance     provenance{
          current_program_version, common.command_line, scene.text, scene.hash, utc_time_now(), 0.};
      std::vector<PlaneFlow> flows;
      if (command.with_flow)
      {
        flows = write_flow_with_progress(command, run, motion.snapshots);
        write_plane_flows(common.output / "flow.h5", flows, provenance);
      }
      write_trajectory_csv(common.output / "trajectory.csv", motion.trajectory, model.dimension());
      write_snapshots(common.output / "snapshots.h5", shapes, provenance);
      write_run_summary_json(common.output / "summary.json", {summary, provenance});

      std::string warning;
      if (command.with_pictures)
        draw_run(common.output, scene, motion.trajectory, summary, shapes, flows, warning);
      for (const std::string &each : summary.warnings)
        warn(each);
      if (!warning.empty())
        remark(warning);
      if (!common.quiet)
        say("  {} periods, net displacement of the last {:+.5g} mm, head first\n  {} instants in {}\n",
            request.n_periods, 1e3 * summary.displacement_per_period_m.back(), motion.snapshots.size(),
            common.output.string());
    }

    void reconstruct_and_report(const ReconstructCommand &command)
    {
      const ReducedModel model = read_reduced_model(find_model(command.model));
      require_inertia(model, command.model, command.inertia.inertia);
      ReducedRun run{model, scene_of_run(command, model), {}, {}, ""};
      warn_of_model_error(model, command.model);
      run.request                    = sweep_options(run.scene, model).base;
      run.request.n_periods          = n_periods(run.scene);
      run.request.samples_per_period = command.n_instants;
      run.inertia                    = carried_inertia(run.scene, model, extreme_of(run));
      run.doubt = accept_doubt(doubt_inertia(run.scene, run.inertia, extreme_of(run)), command.inertia.allowed,
                               "lower the field's frequency or raise fluid.viscosity_Pa_s");
      if (command.with_flow)
        require_full_order_model("--flow", RanksAtWork::this_one);
      work_in_folder(output_request(command.common, written_by::simulate(), {find_model(command.model)}),
                     [&](const Begun &) { reconstruct_in_folder(command, run); });
    }
  } // namespace

  Work add_reconstruct(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<ReconstructCommand>();
    auto *verb    = tool.add_subcommand("reconstruct", "One run of a reduced model: motion, whole tail and flow");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")->required();
    verb->add_option("--instants", command->n_instants, "Instants per period that are written")
        ->check(CLI::Range(3, 10000))
        ->capture_default_str();
    verb->add_option("--rtol", command->relative_tolerance, "Relative tolerance of the time integration")
        ->check(CLI::Range(1e-13, 1e-2))
        ->capture_default_str();
    add_inertia_options(*verb, command->inertia);
    verb->add_flag("--flow", command->with_flow, "Solve for the flow at each instant (fields/ for ParaView, flow.h5)");
    verb->add_flag("--pictures", command->with_pictures, "Draw the motion");
    add_common_options(*verb, command->common, OutputFolder::required);
    command->common.command_line = command_line;
    return [command] {
      if (is_speaker())
        reconstruct_and_report(*command);
    };
  }
} // namespace swimtwin
