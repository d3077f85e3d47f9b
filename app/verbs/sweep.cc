// Verb sweep: displacement against frequency, and against whatever else, on a reduced model.
#include <app/frame/claimed_folder.h>
#include <app/frame/progress_bar.h>
#include <app/frame/shipped_files.h>
#include <app/frame/value_list.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <app/trust/carried_inertia.h>
#include <app/trust/model_error.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <reports/page/draw_pictures.h>
#include <reports/page/number_text.h>
#include <reports/page/shown_units.h>
#include <reports/run/run_picture.h>
#include <reports/sweep/frequency_picture.h>
#include <reports/sweep/model_card.h>
#include <reports/sweep/sweep_files.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace swimtwin
{
  namespace
  {
    struct SweepCommand
    {
      CommonOptions common;
      std::string   model;
      InertiaChoice inertia;
      std::string   frequency, young_modulus, viscosity, magnetization, bx, by; ///< as typed; empty: the scene's own
      int           n_modes = 0, n_threads = 0;
      double        relative_tolerance = IntegratorOptions().relative_tolerance;
      bool          no_picture         = false;
    };

    std::vector<double> values(const char *option, const std::string &text, const ValueRule rule, const bool given)
    {
      return given ? parse_values(option, text, rule) : std::vector<double>();
    }

    SweepAxes axes_of(const SweepCommand &command, const CLI::App &verb)
    {
      const auto given = [&](const char *option) { return verb.count(option) > 0; };
      const auto axis  = [&](const char *option, const std::string &text, const ValueRule rule) {
        return values(option, text, rule, given(option));
      };
      return {axis("--young-modulus", command.young_modulus, ValueRule::positive),
              axis("--viscosity", command.viscosity, ValueRule::positive),
              axis("--magnetization", command.magnetization, ValueRule::finite),
              axis("--bx", command.bx, ValueRule::finite),
              axis("--by", command.by, ValueRule::finite),
              axis("--frequency", command.frequency, ValueRule::positive)};
    }

    ReducedModel load_model(const SweepCommand &command)
    {
      ReducedModel model = read_reduced_model(find_model(command.model));
      if (command.n_modes < 0)
        throw InputError(fmt::format("--modes {} is not possible; choose 1 to {}, or leave it out for all.",
                                     command.n_modes, model.n_modes()));
      return command.n_modes > 0 ? truncated(model, command.n_modes) : model;
    }

    InertialExtreme extreme_of(const SweepAxes &axes, const RunRequest &base)
    {
      const auto largest = [](const std::vector<double> &v, const double otherwise) {
        return v.empty() ? otherwise : *std::max_element(v.begin(), v.end());
      };
      const auto smallest = [](const std::vector<double> &v, const double otherwise) {
        return v.empty() ? otherwise : *std::min_element(v.begin(), v.end());
      };
      return {largest(axes.frequency_Hz, base.drive.frequency_Hz),
              smallest(axes.viscosity_Pa_s, base.parameters.viscosity_Pa_s),
              largest(axes.young_modulus_Pa, base.parameters.young_modulus_Pa)};
    }

    std::size_t n_outside(const std::vector<SweepResult> &results)
    {
      return static_cast<std::size_t>(
          std::count_if(results.begin(), results.end(), [](const SweepResult &r) { return !r.trust.inside(); }));
    }

    std::size_t n_not_computed(const std::vector<SweepResult> &results)
    {
      return results.size() - static_cast<std::size_t>(std::count_if(results.begin(), results.end(), was_computed));
    }

    std::vector<std::string> doubts(const std::vector<SweepResult> &results)
    {
      std::vector<std::string> sentences;
      if (const auto n = n_not_computed(results); n > 0)
        sentences.push_back(
            fmt::format("{} of {} rows were not computed; the column note says why", n, results.size()));
      if (const auto n = n_outside(results); n > 0)
      {
        const auto first =
            std::find_if(results.begin(), results.end(), [](const SweepResult &r) { return !r.trust.inside(); });
        sentences.push_back(
            fmt::format("{} of {} rows are outside what the model was trained for (the first: {}); they "
                        "are marked in {}",
                        n, results.size(), first->trust.text(), sweep_table_name));
      }
      const auto n_without = std::count_if(results.begin(), results.end(), [](const SweepResult &r) {
        return was_computed(r) && !std::isfinite(r.periodic_displacement_m);
      });
      if (n_without > 0)
        sentences.push_back(fmt::format("{} of {} rows have no periodic displacement; the column note says why",
                                        n_without, results.size()));
      return sentences;
    }

    std::string peak_table(const std::vector<FrequencyCurve> &curves)
    {
      std::string text = "  curve                         farthest (mm)   at (Hz)\n";
      for (const FrequencyCurve &curve : curves)
        text +=
            fmt::format("  {:<28}  {:>13}  {:>8}{}\n", curve.name, signed_number(mm * curve.peak().displacement_m, 5),
                        plain_number(curve.peak().frequency_Hz, 4),
                        curve.peaks_at_its_end() && curve.points.size() > 1 ? "  end of the curve" : "");
      return text;
    }

    SweepOptions options_of(const SweepCommand &command, const Scene &scene, const ReducedModel &model)
    {
      SweepOptions options       = sweep_options(scene, model);
      options.relative_tolerance = command.relative_tolerance;
      options.n_threads          = command.n_threads;
      return options;
    }

    void write_files(const CommonOptions &common, const ReducedModel &model, const std::vector<SweepResult> &results,
                     const SweepRecord &record)
    {
      write_sweep_table(common.output / sweep_table_name, results);
      write_sweep_data(common.output / sweep_data_name, results, record);
      write_sweep_summary(common.output / sweep_summary_name, model, results, record);
    }

    /// What a sweep knows before it writes anything.
    struct SweepSetup
    {
      ReducedModel model;
      Scene        scene;
      SweepOptions options;
      SweepRecord  record;
      InertiaTerms carried = {};
    };

    SweepSetup set_up(const SweepCommand &command, const SweepAxes &axes)
    {
      SweepSetup setup{load_model(command), {}, {}, {}, {}};
      if (const std::string warning = model_error_warning(setup.model, command.model); !warning.empty())
        setup.record.warnings.push_back(warning);
      const auto &[inertia, allowed] = command.inertia;
      require_inertia(setup.model, command.model, inertia);
      setup.scene                   = scene_with_inertia(setup.model, inertia);
      setup.options                 = options_of(command, setup.scene, setup.model);
      const InertialExtreme extreme = extreme_of(axes, setup.options.base);
      setup.carried                 = carried_inertia(setup.scene, setup.model, extreme);
      setup.options.densities       = inertial_densities(setup.scene, setup.carried);
      const std::string doubt       = accept_doubt(doubt_inertia(setup.scene, setup.carried, extreme), allowed,
                                                   "lower --frequency or raise --viscosity");
      if (!doubt.empty())
        setup.record.warnings.push_back(doubt);
      return setup;
    }

    /// On top of the error that runs without inertia had.
    void add_error_of_inertia(const SweepSetup &setup, std::vector<SweepResult> &results)
    {
      for (SweepResult &r : results)
      {
        const InertialExtreme member = extreme_of(r.member.parameters, r.member.frequency_Hz);
        r.error_95_m += std::abs(r.displacement_m) * error_of_inertia(setup.scene, setup.carried, member);
        note_error_bound(setup.model.record, r.error_95_m, r.displacement_m, r.trust);
      }
    }

    void sweep_in_folder(const SweepCommand &command, const SweepAxes &axes, SweepSetup &setup)
    {
      auto &[model, scene, options, record, carried] = setup;
      const CommonOptions &common                    = command.common;
      if (!common.quiet)
        say_text(model_card(model));
      const double start = wall_time_s();
      ProgressBar  bar(common.quiet);
      const int    n_members = static_cast<int>(axes.n_members());
      options.on_progress    = [&](const std::size_t done) {
        bar.show(static_cast<int>(done), n_members, static_cast<int>(done), wall_time_s() - start);
      };
      std::vector<SweepResult> results = sweep(model, axes, options);
      record.wall_time_s               = wall_time_s() - start;
      add_error_of_inertia(setup, results);
      for (const SweepResult &result : results)
        record.cpu_time_s += result.cpu_time_s;
      for (const std::string &doubt : doubts(results))
        record.warnings.push_back(doubt);

      const std::vector<FrequencyCurve> curves = curves_of(results);
      record.model_file                        = find_model(command.model).string();
      record.n_modes                           = model.n_modes();
      record.n_threads                         = n_sweep_threads(options, results.size());
      record.n_members                         = results.size();
      record.n_outside_trained_range           = n_outside(results);
      record.n_not_computed                    = n_not_computed(results);
      record.status                            = record.n_not_computed == 0 ? "completed"
                                                                            : fmt::format("failed: {} of {} members were not computed",
                                                                                          record.n_not_computed, record.n_members);
      record.provenance                        = {current_program_version, common.command_line, scene.text, scene.hash,
                                                  utc_time_now(),          record.wall_time_s};
      write_files(common, model, results, record);
      for (const std::string &warning : record.warnings)
        warn(warning);
      if (curves.empty())
        throw ComputationError(fmt::format("no member of the sweep was computed: {}", results.front().note));
      draw_beside_results(common.output, {frequency_picture(curves, common.output.filename().string())},
                          common.command_line);
      if (common.quiet)
        return;
      say("{}  {} runs in {:.3g} s on {} threads, {:.2g} ms of CPU time each: three periods, the periodic motion and "
          "the error indicator\n  results in {}\n",
          peak_table(curves), results.size(), record.wall_time_s, record.n_threads,
          1e3 * record.cpu_time_s / static_cast<double>(results.size()), common.output.string());
    }

    void sweep_and_report(const SweepCommand &command, const SweepAxes &axes)
    {
      SweepSetup setup = set_up(command, axes);
      work_in_folder(output_request(command.common, written_by::sweep(), {find_model(command.model)}),
                     [&](const Begun &) { sweep_in_folder(command, axes, setup); });
    }
  } // namespace

  Work add_sweep(CLI::App &tool, const std::string &command_line)
  {
    auto  command = std::make_shared<SweepCommand>();
    auto *verb =
        tool.add_subcommand("sweep", "Displacement against frequency and other parameters, on a reduced model");
    verb->add_option("model", command->model, "Reduced model (model.h5), or name of a shipped one")->required();
    const auto add = [&](const char *option, std::string &text, const char *what) {
      verb->add_option(option, text, what)->type_name("VALUES")->take_last();
    };
    add("--frequency", command->frequency,
        "Hz: a number, a list 0.5,0.8, or a range low:high:number[:log], here and below");
    add("--young-modulus", command->young_modulus, "Pa, of the tail");
    add("--viscosity", command->viscosity, "Pa s");
    add("--magnetization", command->magnetization, "A/m, of the head");
    add("--bx", command->bx, "T, constant component of the field");
    add("--by", command->by, "T, amplitude of its swinging component");
    verb->add_option("--modes", command->n_modes, "Use the first modes only");
    verb->add_option("--rtol", command->relative_tolerance, "Relative tolerance of the time integration")
        ->check(CLI::Range(1e-13, 1e-2))
        ->capture_default_str();
    verb->add_option("--threads", command->n_threads, "Number of threads; 0: as many as there are cores")
        ->check(CLI::Range(0, 4096));
    add_inertia_options(*verb, command->inertia);
    add_output_options(*verb, command->common, OutputFolder::required);
    command->common.command_line = command_line;
    return [command, verb] {
      if (is_speaker())
        sweep_and_report(*command, axes_of(*command, *verb));
    };
  }
} // namespace swimtwin
