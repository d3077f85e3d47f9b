// Verb optimize: the field that swims fastest within what coils can play, and proof of it.
#include <app/verbs/optimize.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/shipped_files.h>
#include <app/frame/value_list.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <app/full_order/field_replay.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/model_refinement.h>
#include <app/trust/model_error.h>
#include <control/field/field_import.h>
#include <control/goal/goal_file.h>
#include <control/goal/measured_field.h>
#include <control/stroke/gradient_check.h>
#include <datasets/scene/field_program_writer.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <reports/page/illustrated_page.h>
#include <reports/page/number_text.h>
#include <reports/plan/plan_files.h>
#include <reports/plan/plan_pictures.h>
#include <reports/plan/plan_report.h>
#include <reports/run/run_picture.h>
#include <reports/sweep/model_card.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace swimtwin
{
  namespace
  {
    /// The goal's own field program, if it names one: warned of where its units are doubtful.
    void import_program(GoalFile &file, std::vector<std::string> &warnings)
    {
      if (file.program.empty())
        return;
      const FieldProgram program = FieldProgram::read_csv(file.program, file.program_period_s);
      for (const std::string &doubt : unit_doubts(program))
        warnings.push_back(fmt::format("{}: {}", file.program.string(), doubt));
      const ImportedField imported = import_field(program, file.goal.n_harmonics);
      constexpr double    noticed  = 0.01; // of the largest field
      const double        size     = imported.drive.parameters.lpNorm<Eigen::Infinity>();
      if (imported.loss_T > noticed * size)
        warnings.push_back(fmt::format("{}: {} harmonics leave up to {:.2g} T of it out", file.program.string(),
                                       file.goal.n_harmonics, imported.loss_T));
      file.options.given = imported.drive;
    }

    /// The scene's field if it is a sinusoid, else one of the same size.
    Drive reference_drive(const Scene &scene)
    {
      const FieldProgram &field = scene.field;
      if (field.waveform() == FieldProgram::Waveform::sinusoidal)
        return make_drive(field);
      constexpr double reference_T = 5e-3, reference_Hz = 0.8; // of the reference study
      return make_drive(FieldProgram::sinusoidal(reference_T, reference_T, reference_Hz));
    }

    void print_checks(const std::vector<GradientCheck> &checks)
    {
      say("  derivative of            largest, per scale   off by (relative)\n");
      for (const GradientCheck &check : checks)
        say("  {:<32} {:>11.4g} {:>19.1e}\n", check.name, check.size, check.difference);
    }

    /// At a field between the reference sinusoid and none of its symmetries.
    void check_and_print(const ReducedModel &model, const GoalFile &file, const Drive &reference)
    {
      const ReducedSwimmer  swimmer(model, inertial_densities(model, file.goal.inertia));
      const FieldVariables  variables(file.goal.n_harmonics, file.goal.family);
      const Eigen::VectorXd scale = field_box(variables, file.goal).scale;
      Eigen::VectorXd       x     = variables.variables(reference);
      for (Eigen::Index i = 0; i + 1 < x.size(); ++i)
        x[i] += 0.3 * scale[i] * std::cos(3. * static_cast<double>(i)); // any numbers without a pattern
      print_checks(check_gradients(model, swimmer, file.goal, variables, x));
    }

    /// Periods enough to see the drift.
    void write_motions(const ReducedModel &model, const InertiaTerms &inertia, const PlanResult &plan,
                       const std::filesystem::path &folder)
    {
      constexpr int        periods = 6, samples = 60;
      const ReducedSwimmer swimmer(model, inertial_densities(model, inertia));
      SwimmerIntegrator    integrator(swimmer, {});
      std::filesystem::create_directories(folder);
      for (const PlannedField &field : plan.fields)
        if (field.moves)
        {
          const RunRequest request{{plan.young_modulus_Pa, plan.viscosity_Pa_s, plan.magnetization_A_m, 0.},
                                   drive_of(field),
                                   start_of(field),
                                   periods,
                                   samples};
          write_trajectory_csv(folder / (file_name(field.name) + ".csv"), integrator.run(request).trajectory,
                               model.dimension());
        }
    }

    std::string field_table(const PlanResult &plan)
    {
      std::string text =
          "  field               mean speed (um/s)   at (Hz)   multiplier   periods integrated   status\n";
      for (const PlannedField &field : plan.fields)
        if (field.moves)
          text += fmt::format("  {:<18}  {:>17}  {:>8}  {:>11}  {:>19}   {}\n", field.name,
                              plain_number(1e6 * field.mean_speed_m_s, 4), plain_number(field.frequency_Hz, 4),
                              field.multipliers.empty() ? "unknown" : plain_number(field.multipliers.front(), 3),
                              field.n_periods, field.status);
        else
          text += fmt::format("  {:<18}  {}: {}\n", field.name, field.status, field.message);
      return text;
    }

    /// Of the two searches at one bound, what did not converge.
    std::string shortfall(const TradeOffPoint &point)
    {
      const std::string converged = "converged";
      if (point.tuned_status == converged && point.optimal_status == converged)
        return "";
      return fmt::format("  (tuned: {}, optimal: {})", point.tuned_status, point.optimal_status);
    }

    std::string trade_off_text(const PlanResult &plan)
    {
      std::string text;
      for (const TradeOffPoint &point : plan.trade_off)
        text += fmt::format("  multiplier up to {:<6.3g} tuned {:>7.4g}, optimal {:>7.4g} um/s: gain {:.3g}{}\n",
                            point.largest_multiplier, 1e6 * point.tuned_speed_m_s, 1e6 * point.optimal_speed_m_s,
                            point.optimal_speed_m_s / point.tuned_speed_m_s, shortfall(point));
      const auto n_short = std::count_if(plan.trade_off.begin(), plan.trade_off.end(),
                                         [](const TradeOffPoint &point) { return !shortfall(point).empty(); });
      if (n_short > 0)
        text += fmt::format("  {} of {} bounds have a search that did not converge\n", n_short, plan.trade_off.size());
      return text;
    }

    void draw_and_write_page(const OptimizeCommand &command, const PlanFolder &folder)
    {
      Illustrations drawn;
      if (!command.no_picture)
        drawn = illustrate(command.common.output, plan_pictures(folder), command.common.command_line);
      write_illustrated_page(command.common.output, plan_page(folder, drawn), drawn);
    }

    /// What a plan is made from, read before anything is written.
    struct PlanInput
    {
      const ReducedModel             &model;
      const Scene                    &scene;
      GoalFile                       &file;
      const std::vector<std::string> &warnings; ///< of its field program
      Refinement                      refinement;
    };

    /// The goal's swimmer, or the member of a robust goal, that needs inertia most.
    InertialExtreme extreme_of(const Scene &scene, const SwimmingGoal &goal, const double frequency_Hz)
    {
      InertialExtreme most = extreme_of(goal.swimmer, frequency_Hz);
      for (const SwimmerParameters &member : members_of(goal))
        if (const InertialExtreme other = extreme_of(member, frequency_Hz);
            other.shares(scene).together() > most.shares(scene).together())
          most = other;
      return most;
    }

    /// Of the goal's swimmer, or of the member of a robust goal that is worst.
    InertiaDoubt doubt_of(const Scene &scene, const SwimmingGoal &goal, const double frequency_Hz)
    {
      InertiaDoubt worst = doubt_inertia(scene, goal.inertia, extreme_of(scene, goal, frequency_Hz));
      for (const SwimmerParameters &member : members_of(goal))
        if (const InertiaDoubt doubt = doubt_inertia(scene, goal.inertia, extreme_of(member, frequency_Hz));
            doubt.is_wrong && !worst.is_wrong)
          worst = doubt;
      return worst;
    }

    /// At the higher of the frequencies that the gain is of.
    InertiaDoubt doubt_of(const Scene &scene, const SwimmingGoal &goal, const PlanResult &plan)
    {
      double highest_Hz = 0.;
      for (const char *name : {optimal_field_name, tuned_field_name})
        if (const PlannedField *field = plan.find(name); field && field->moves)
          highest_Hz = std::max(highest_Hz, field->frequency_Hz);
      return highest_Hz > 0. ? doubt_of(scene, goal, highest_Hz) : InertiaDoubt();
    }

    PlanResult make_plan(const OptimizeCommand &command, const PlanInput &input)
    {
      const auto &[model, scene, file, warnings, refinement] = input;
      file.options.search.n_threads                          = command.n_threads;
      if (is_speaker() && !command.common.quiet)
        file.options.on_progress = [](const std::string &what) { say("  searching: {}\n", what); };
      PlanResult plan = plan_field(model, file.goal, reference_drive(scene), file.options, members_of(file.goal));
      plan.warnings.insert(plan.warnings.begin(), warnings.begin(), warnings.end());
      if (const InertiaDoubt doubt = doubt_of(scene, file.goal, plan); !doubt.finding.empty())
        plan.warnings.push_back(doubt.warning());
      plan.scene_name        = model.scene_name;
      plan.goal_text         = file.text;
      plan.young_modulus_Pa  = file.goal.swimmer.young_modulus_Pa;
      plan.viscosity_Pa_s    = file.goal.swimmer.viscosity_Pa_s;
      plan.magnetization_A_m = file.goal.swimmer.magnetization_A_m;
      plan.inertia           = names_of(file.goal.inertia);
      plan.sample_rate_Hz    = file.sample_rate_Hz;
      plan.provenance        = {current_program_version, command.common.command_line, scene.text, scene.hash,
                                utc_time_now(),          plan.search_time_s};
      return plan;
    }

    void write_field(const CommonOptions &common, const PlanResult &plan)
    {
      const PlannedField &best = *plan.find(optimal_field_name);
      if (best.bx_T.empty())
        return;
      write_field_program(
          common.output / field_name, sampled_program(drive_of(best), plan.sample_rate_Hz),
          fmt::format("{}: {} ({}); the gain is {}", best.name, best.status, best.message, plan.confirmation()));
    }

    bool is_usable(const PlanResult &plan)
    {
      return plan.status == "converged" || plan.status == "stalled" || plan.status == "budget exhausted";
    }

    void conclude(const OptimizeCommand &command, const PlanResult &plan, const InertiaDoubt &doubt)
    {
      warn_of(plan.warnings, doubt, command.inertia.allowed);
      if (!command.common.quiet)
        say("{}{}  gain {:.3g} over the tuned sinusoid, found in {:.3g} s\n  {}\n  results in {}\n", field_table(plan),
            trade_off_text(plan), plan.gain(), plan.search_time_s, plan.confirmation(), command.common.output.string());
      if (!is_usable(plan))
        throw ComputationError(fmt::format("no field was found ({}): {}", plan.status, plan.message));
      if (doubt.refuses(command.inertia.allowed))
        throw ComputationError(doubt.refusal("lower [field] frequency_high_Hz or raise [swimmer] viscosity_Pa_s"));
    }

    /// A plan by this model, with its replay if one is asked for.
    PlanResult plan_and_replay(const OptimizeCommand &command, const PlanInput &input,
                               const std::filesystem::path &model_file)
    {
      PlanResult plan = make_plan(command, input);
      plan.model_file = model_file.string();
      if (command.has_replay() && is_usable(plan) && std::isfinite(plan.gain()))
        plan.replay = replay_on_full_order_model(input.model, plan, command.common, command.replay);
      return plan;
    }

    std::vector<std::filesystem::path> replayed_snapshots(const PlanResult &plan, const std::filesystem::path &folder)
    {
      std::vector<std::filesystem::path> files;
      for (const ReplayedField &field : plan.replay->fields)
        files.push_back(folder / replay_folder_name(field.name) / "snapshots.h5");
      return files;
    }

    /// Plans again on refined models.
    PlanResult refine_and_plan(const OptimizeCommand &command, const PlanInput &input, PlanResult plan,
                               RefinedModel &by)
    {
      ModelUse use;
      use.inertia    = input.file.goal.inertia;
      use.difference = [&] { return plan.replay ? std::optional(plan.replay->largest_difference()) : std::nullopt; };
      use.snapshots  = [&] { return replayed_snapshots(plan, command.common.output); };
      use.again      = [&](const RefinedModel &refined) {
        PlanResult next = plan_and_replay(
                 command, {refined.model, input.scene, input.file, input.warnings, input.refinement}, refined.file);
        if (!next.replay)
          throw ComputationError(fmt::format("its plan is {}: {}", next.status, next.message));
        plan = std::move(next);
      };
      const RefinementReport report = refine_in_use(input.refinement, by, command.common, use);
      report.add_to(plan); // to the last one
      return plan;
    }

    /// All of it that the goal's highest frequency needs. Refused is what cannot be right at the lowest.
    void choose_inertia(const OptimizeCommand &command, const ReducedModel &model, const Scene &scene,
                        SwimmingGoal &goal)
    {
      goal.inertia             = carried_inertia(scene, model, extreme_of(scene, goal, goal.frequency_Hz.high));
      const InertiaDoubt doubt = doubt_of(scene, goal, goal.frequency_Hz.low);
      accept_doubt(doubt, command.inertia.allowed, "lower [field] frequency_low_Hz or raise [swimmer] viscosity_Pa_s");
    }

    void optimize_in_folder(const OptimizeCommand &command, const PlanInput &input)
    {
      const CommonOptions &common = command.common;
      if (is_speaker() && !common.quiet)
        say_text(model_card(input.model));
      RefinedModel by{input.model, find_model(command.model)};
      PlanResult   plan = plan_and_replay(command, input, by.file);
      if (command.refine.is_asked_for())
        plan = refine_and_plan(command, input, std::move(plan), by);
      const ReducedModel &model = by.model;
      if (!is_speaker())
        return;
      write_motions(model, input.file.goal.inertia, plan, common.output / motion_folder_name);
      write_field(common, plan);
      write_plan_result(common.output / plan_name, plan);
      draw_and_write_page(command, read_plan(common.output));
      conclude(command, plan, doubt_of(input.scene, input.file.goal, plan));
    }
  } // namespace

  void optimize_and_report(const OptimizeCommand &command)
  {
    const ReducedModel model = read_reduced_model(find_model(command.model));
    require_inertia(model, command.model, command.inertia.inertia);
    const Scene scene = scene_with_inertia(model, command.inertia.inertia);
    GoalFile    file  = read_goal(command.goal, model);
    choose_inertia(command, model, scene, file.goal);
    if (is_speaker())
      require_borne_model_error(model, command.model, command.accepts_model_error);
    if (command.check_gradients && is_speaker())
      check_and_print(model, file, reference_drive(scene));
    if (command.check_gradients)
      return;
    const Refinement         refinement(command.refine);
    std::vector<std::string> warnings;
    import_program(file, warnings);
    if (!command.trade_off.empty())
      file.options.trade_off = parse_values("--trade-off", command.trade_off, ValueRule::positive);
    if (command.has_replay())
      require_full_order_model(command.with_replay ? "--replay" : "--refine", RanksAtWork::all);
    const std::vector<std::filesystem::path> inputs{find_model(command.model), command.goal, file.program};
    work_in_folder_together(output_request(command.common, written_by::optimize(), inputs), [&](const Begun &) {
      optimize_in_folder(command, {model, scene, file, warnings, refinement});
    });
  }

  Work add_optimize(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<OptimizeCommand>();
    auto *verb    = tool.add_subcommand("optimize", "The periodic field that reaches a goal best, on a reduced model");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")->required();
    verb->add_option("goal", command->goal, "What to reach within which limits (TOML)")->required();
    add_output_options(*verb, command->common, OutputFolder::optional);
    verb->add_flag("--replay", command->with_replay,
                   "Run the optimum and the tuned sinusoid on the full-order model and compare the gains");
    verb->add_option("--replay-periods", command->replay.periods, "Periods of a replay; the last one counts")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    verb->add_option("--replay-steps", command->replay.steps_per_period, "Steps per period of a replay")
        ->check(CLI::Range(20, 100000))
        ->capture_default_str();
    add_refine_options(*verb, command->refine);
    add_inertia_options(*verb, command->inertia);
    verb->add_option("--trade-off", command->trade_off,
                     "Plan for these bounds on the Floquet multiplier too: a list or a range, as in sweep")
        ->type_name("VALUES");
    verb->add_flag("--check-gradients", command->check_gradients, "Compare all derivatives with differences, and stop");
    verb->add_option("--threads", command->n_threads, "As many as the machine has if left out");
    verb->add_flag("--no-picture", command->no_picture, "Draw nothing");
    verb->add_flag(accept_model_error, command->accepts_model_error, accept_model_error_help);
    command->common.command_line = command_line;
    return [command] {
      if (!command->check_gradients && command->common.output.empty())
        throw InputError("--output is missing; give the folder for the results.");
      optimize_and_report(*command);
    };
  }
} // namespace swimtwin
