// Verb calibrate: fit the swimmer to displacement-frequency data, and say what the data cannot tell.
#include <app/verbs/calibrate.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/progress_bar.h>
#include <app/frame/shipped_files.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/full_order_run.h>
#include <app/full_order/model_refinement.h>
#include <app/trust/carried_inertia.h>
#include <app/trust/model_error.h>
#include <app/verbs/calibration_input.h>
#include <calibration/run/calibrate.h>
#include <calibration/run/fitted_scene.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <reports/fit/calibration_files.h>
#include <reports/fit/calibration_pictures.h>
#include <reports/fit/calibration_report.h>
#include <reports/page/illustrated_page.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace swimtwin
{
  namespace
  {
    /// What the observations need of inertia, at the scene's viscosity and stiffness.
    InertialExtreme extreme_of(const Scene &scene, const std::vector<ObservationSet> &sets)
    {
      double frequency_Hz = 0.;
      for (const ObservationSet &set : sets)
        for (const Observation &observation : set.points)
          frequency_Hz = std::max(frequency_Hz, observation.frequency_Hz);
      return {frequency_Hz, scene.fluid->viscosity_Pa_s, scene.tail->young_modulus_Pa};
    }

    bool have_inertia(const std::vector<ObservationSet> &sets)
    {
      return std::any_of(sets.begin(), sets.end(), [](const ObservationSet &set) { return set.has_inertia; });
    }

    /// "none" if the data are without, as computed ones may be; else as the scene has it.
    std::string inertia_of_data(const std::vector<ObservationSet> &sets)
    {
      const auto without = [](const ObservationSet &set) { return !set.has_inertia; };
      const auto n       = std::count_if(sets.begin(), sets.end(), without);
      if (n > 0 && n < static_cast<long>(sets.size()))
        throw InputError(
            fmt::format("{} was computed without inertia ([fluid] inertia in its sidecar), other data have it; "
                        "fit them one by one, or choose with --inertia.",
                        std::find_if(sets.begin(), sets.end(), without)->name));
      return n > 0 ? "none" : "";
    }

    /// Throws InputError where estimates would make up for much, and nobody said that they may.
    void require_inertia_of_data(const Scene &scene, const CalibrationInput &input, const InertiaTerms &carried)
    {
      const InertiaDoubt doubt = doubt_inertia(scene, carried, extreme_of(scene, input.sets));
      if (doubt.missed > largest_inertial_error)
        throw InputError(
            fmt::format("{}, which the data have and the estimates would make up for; {}say --inertia none "
                        "to fit all the same.",
                        doubt.finding,
                        input.model.inertia.is_given() ? "carry it with --inertia full, or "
                                                       : "take a model that is trained with inertia, or "));
    }

    InertiaTerms carried_by(const CalibrateCommand &command, const CalibrationInput &input)
    {
      const std::string inertia = command.inertia.empty() ? inertia_of_data(input.sets) : command.inertia;
      require_inertia(input.model, command.model, inertia);
      const Scene        scene   = scene_with_inertia(input.model, inertia);
      const InertiaTerms carried = carried_inertia(scene, input.model, extreme_of(scene, input.sets));
      if (command.inertia.empty() && have_inertia(input.sets))
        require_inertia_of_data(scene, input, carried);
      return carried;
    }

    /// A refinement needs some, spread over the frequencies.
    int n_checks_of(const CalibrateCommand &command)
    {
      constexpr int fewest_to_refine = 3;
      return command.refine.is_asked_for() ? std::max(fewest_to_refine, command.n_checks) : command.n_checks;
    }

    std::filesystem::path check_folder(const CalibrateCommand &command, const int n)
    {
      return command.common.output / fmt::format("full-order/{}", n);
    }

    CalibrationOptions options_of(const CalibrateCommand &command, const ReducedModel &model,
                                  const InertiaTerms &carried, ProgressBar &bar)
    {
      CalibrationOptions options;
      options.n_threads  = command.n_threads;
      options.n_checks   = n_checks_of(command);
      options.inertia    = carried;
      options.full_order = [&model, &command, carried, n = 0](const CalibratedSwimmer &swimmer,
                                                              const SwimmingCondition &condition) mutable {
        const FieldProgram field = FieldProgram::sinusoidal(
            condition.drive.parameters[0], condition.drive.parameters[1], condition.drive.frequency_Hz);
        return full_order_displacement_m(scene_of_observation(model, swimmer, carried, field, condition.period),
                                         check_folder(command, ++n));
      };
      const double start  = wall_time_s();
      options.on_progress = [&bar, start](const std::string &, const double done) {
        bar.show(static_cast<int>(100 * done), 100, static_cast<int>(100 * done), wall_time_s() - start);
      };
      return options;
    }

    std::string bound_text(const std::optional<double> &bound)
    {
      return bound ? fmt::format("{:.5g}", *bound) : "open";
    }

    std::string parameter_table(const CalibrationResult &result)
    {
      std::string text = fmt::format("  {:<38} {:>12}   {:g} % interval\n", "parameter", "value", 100. * result.level);
      for (const CalibratedParameter &p : result.parameters)
      {
        if (p.role == ParameterRole::fixed)
          continue;
        const ClaimedInterval &i = p.interval();
        text += fmt::format("  {:<38} {:>12.5g}   {}\n", p.name, p.value,
                            p.undetermined ? "none: not determined by the data"
                                           : fmt::format("{} to {}  ({})", bound_text(i.low), bound_text(i.high),
                                                         p.role == ParameterRole::derived ? "derived" : i.method));
      }
      return text;
    }

    std::string story(const CalibrationResult &result)
    {
      std::string text =
          fmt::format("  status       {}: {}\n{}", result.status, result.message, parameter_table(result));
      if (!result.inertia.empty())
        text += fmt::format("  inertia      carried: {}\n", fmt::join(result.inertia, ", "));
      text += fmt::format("  misfit       chi^2 = {:.4g} for {} observations and {} degrees of freedom\n",
                          result.chi_squared, result.n_observations, result.n_degrees_of_freedom);
      for (const NullDirection &null : result.null_directions)
        text += fmt::format("  null         {}{}\n", null.reading, null.has_prior ? " (a prior decides it)" : "");
      if (result.next)
        text += fmt::format("  next         an observation at {:.4g} Hz ({}) shortens the interval of {} to {:.3g} of "
                            "its length\n",
                            result.next->best_frequency_Hz, result.next->data_set, result.next->parameter,
                            result.next->best_interval_ratio);
      if (!result.discrepancy.verdict.empty())
        text += fmt::format("  full order   {}\n", result.discrepancy.verdict);
      return text;
    }

    /// What the fit's parameters have to make up for of the inertia that the reduced swimmer leaves out, or carries to
    /// first order only; empty if that is little, or if the data have none.
    std::string made_up_for(const Scene &scene, const InertiaTerms &carried, const std::vector<ObservationSet> &sets)
    {
      const InertiaDoubt doubt = doubt_inertia(scene, carried, extreme_of(scene, sets));
      if (doubt.finding.empty() || !(carried.any() || have_inertia(sets)))
        return {};
      return doubt.finding +
             " (with the scene's viscosity and stiffness); where the data have it, the estimates make up "
             "for it";
    }

    void complete(const CalibrateCommand &command, const ReducedModel &model, const CalibrationProblem &problem,
                  const std::vector<ObservationSet> &sets, const InertiaTerms &carried, const double wall_time_s,
                  CalibrationResult &result)
    {
      const Scene scene   = parse_scene(model.scene_text, model.scene_name + ".toml");
      result.scene_name   = model.scene_name;
      result.problem_text = problem.text;
      if (const std::string doubt = made_up_for(scene, carried, sets); !doubt.empty())
        result.warnings.push_back(doubt);
      for (const ObservationSet &set : sets)
        result.data_files.push_back(set.file.string());
      result.provenance = {
          current_program_version, command.common.command_line, scene.text, scene.hash, utc_time_now(), wall_time_s};
    }

    void draw_and_write_page(const CalibrateCommand &command, const CalibrationResult &result)
    {
      const CommonOptions &common = command.common;
      Illustrations        drawn;
      if (!command.no_picture)
        drawn = illustrate(common.output, calibration_pictures(result), common.command_line);
      write_illustrated_page(common.output, calibration_page(result, common.output.filename().string(), drawn), drawn);
    }

    void print_warnings(const std::vector<std::string> &warnings)
    {
      for (const std::string &warning : warnings)
        warn(warning);
    }

    bool names_a_model(const std::string &name)
    {
      return std::filesystem::path(name).extension() == ".h5" || find_model(name) != name;
    }

    bool names_a_problem(const std::string &name)
    {
      return std::filesystem::path(name).extension() == ".toml";
    }

    /// `--data a.csv b.csv MODEL PROBLEM`: what ends the list of data may be what else is needed.
    void take_back_from_data(CalibrateCommand &command)
    {
      std::vector<std::string> &data = command.data;
      if (command.problem.empty() && data.size() > 1 && names_a_problem(data.back()))
      {
        command.problem = data.back();
        data.pop_back();
      }
      if (command.model.empty() && data.size() > 1 && names_a_model(data.back()))
      {
        command.model = data.back();
        data.pop_back();
      }
      if (command.model.empty() || command.problem.empty())
        throw InputError(
            fmt::format("calibrate: {} is required; say swimtwin calibrate MODEL PROBLEM.toml --data FILE ...",
                        command.model.empty() ? "the model" : "the problem"));
    }

    void check_and_report(const CalibrateCommand &command)
    {
      const CalibrationInput input = read_calibration_input(command);
      warn_of_model_error(input.model, command.model);
      const std::vector<std::string> warnings =
          check_before_fit(input.model, input.problem, input.sets, carried_by(command, input));
      print_warnings(warnings);
      if (!command.common.quiet)
        say("{}  nothing forbids a fit; warnings: {}\n", summary(input), warnings.size());
    }

    CalibrationResult fit(const CalibrateCommand &command, const CalibrationInput &input, const InertiaTerms &carried,
                          const RefinedModel &by)
    {
      ProgressBar       bar(command.common.quiet);
      CalibrationResult result =
          calibrate(by.model, input.problem, input.sets, options_of(command, by.model, carried, bar));
      result.model_file = by.file.string();
      return result;
    }

    /// Whether no full-order run failed.
    bool is_checked(const CalibrationResult &result)
    {
      return result.discrepancy.moved_estimate.size() > 0;
    }

    /// Fits again with refined models.
    CalibrationResult refine_and_fit(const CalibrateCommand &command, const CalibrationInput &input,
                                     const InertiaTerms &carried, const Refinement &refinement,
                                     CalibrationResult result, RefinedModel &by)
    {
      ModelUse use;
      use.inertia    = carried;
      use.difference = [&]() -> std::optional<double> {
        if (!is_checked(result))
          return {};
        return result.discrepancy.largest_difference();
      };
      use.snapshots = [&] {
        std::vector<std::filesystem::path> files;
        for (std::size_t i = 0; i < result.discrepancy.checks.size(); ++i)
          files.push_back(check_folder(command, static_cast<int>(i) + 1) / "snapshots.h5");
        return files;
      };
      use.again = [&](const RefinedModel &refined) {
        CalibrationResult next = fit(command, input, carried, refined);
        if (!is_checked(next))
          throw ComputationError(next.discrepancy.verdict);
        result = std::move(next);
      };
      const RefinementReport report = refine_in_use(refinement, by, command.common, use);
      report.add_to(result); // to the last one
      return result;
    }

    void calibrate_in_folder(const CalibrateCommand &command, const Refinement &refinement,
                             const CalibrationInput &input)
    {
      const auto &[as_it_came, problem, sets] = input;
      const CommonOptions &common             = command.common;
      const double         start              = wall_time_s();
      const InertiaTerms   carried            = carried_by(command, input);
      RefinedModel         by{as_it_came, find_model(command.model)};
      CalibrationResult    result = fit(command, input, carried, by);
      if (command.refine.is_asked_for())
        result = refine_and_fit(command, input, carried, refinement, std::move(result), by);
      const ReducedModel &model = by.model;
      complete(command, model, problem, sets, carried, wall_time_s() - start, result);
      write_calibration_files(common.output, result,
                              fitted_scene(model, result.swimmer, carried, sets.front(), common.output));
      draw_and_write_page(command, result);
      print_warnings(result.warnings);
      if (!common.quiet)
        say("{}  fit in {:.3g} s, uncertainty in {:.3g} s, {} runs of the reduced swimmer\n  results in {}\n",
            story(result), result.fit_time_s, result.uncertainty_time_s, result.n_runs, common.output.string());
      if (result.status == "stalled")
        throw ComputationError(fmt::format("the fit did not converge: {}; see {}", result.message,
                                           (common.output / calibration_result_name).string()));
    }
  } // namespace

  void calibrate_and_report(const CalibrateCommand &command)
  {
    if (command.common.output.empty())
      throw InputError(
          "--output is required: name a folder for the results, or say --check to look at problem and data "
          "without a fit.");
    const Refinement       refinement(command.refine);
    const CalibrationInput input = read_calibration_input(command);
    require_borne_model_error(input.model, command.model, command.accepts_model_error);
    if (n_checks_of(command) > 0)
    {
      require_repeatable(input.sets);
      require_full_order_model(command.n_checks > 0 ? "--verify" : "--refine", RanksAtWork::this_one);
    }
    std::vector<std::filesystem::path> files{find_model(command.model), command.problem};
    for (const ObservationSet &set : input.sets)
      files.insert(files.end(), {set.file, set.field.file});
    work_in_folder(output_request(command.common, written_by::calibrate(), files),
                   [&](const Begun &) { calibrate_in_folder(command, refinement, input); });
  }

  Work add_calibrate(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<CalibrateCommand>();
    auto *verb = tool.add_subcommand("calibrate", "Fit the swimmer to displacement-frequency data on a reduced model");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")
        ->option_text("TEXT REQUIRED");
    verb->add_option("problem", command->problem, "What is free, and within which bounds (TOML)")
        ->option_text("TEXT REQUIRED");
    verb->add_option("--data", command->data, "Observations (one or more files), instead of those the problem names")
        ->type_name("FILE")
        ->expected(1, -1);
    verb->add_option("--threads", command->n_threads, "0: as many as the machine has")
        ->check(CLI::NonNegativeNumber)
        ->take_last();
    verb->add_option("--verify", command->n_checks, "Runs of the full-order model at the estimate (about 15 s each)")
        ->check(CLI::NonNegativeNumber)
        ->take_last();
    add_refine_options(*verb, command->refine);
    add_inertia_option(*verb, command->inertia);
    verb->add_flag("--check", command->check_only,
                   "Read problem and observations, print what is in them and what is wrong, and fit nothing");
    verb->add_flag("--no-picture", command->no_picture, "Draw nothing");
    add_output_options(*verb, command->common, OutputFolder::optional);
    verb->add_flag(accept_model_error, command->accepts_model_error, accept_model_error_help);
    command->common.command_line = command_line;
    return [command] {
      take_back_from_data(*command);
      if (is_speaker())
        (command->check_only ? check_and_report : calibrate_and_report)(*command);
    };
  }
} // namespace swimtwin
