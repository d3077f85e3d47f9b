// Verb demo: what the tool does, in a few minutes.
#include <app/frame/claimed_folder.h>
#include <app/frame/shipped_files.h>
#include <app/frame/written_files.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/simulation_report.h>
#include <app/verbs/calibrate.h>
#include <app/verbs/optimize.h>
#include <datasets/system/console.h>
#include <datasets/text/csv_table.h>
#include <reports/page/draw_pictures.h>
#include <reports/sweep/frequency_picture.h>
#include <reports/sweep/model_card.h>
#include <reports/sweep/sweep_files.h>

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>

namespace swimtwin
{
  namespace
  {
    /// Points of the full-order model at one magnetization, computed by bench/displacement-frequency.
    std::vector<FrequencyCurve> full_order_curves(const double magnetization_A_m)
    {
      const CsvTable table = CsvTable::read(shipped_file("reference/displacement-frequency.csv"));
      const auto     E = table.column("young_modulus_Pa"), M = table.column("magnetization_A_m"),
                 f = table.column("frequency_Hz"), d = table.column("displacement_m");
      std::vector<SweepPoint> points;
      for (std::size_t k = 0; k < table.n_rows(); ++k)
        if (M[k] == magnetization_A_m)
          points.push_back({E[k], M[k], f[k], d[k]});
      return frequency_curves(points);
    }

    SweepAxes axes_of_curve()
    {
      SweepAxes     axes{{5e4, 8e4, 2e5}, {}, {}, {}, {}, {}};
      constexpr int n = 60;
      for (int k = 0; k < n; ++k)
        axes.frequency_Hz.push_back(.1 * std::pow(30., double(k) / (n - 1)));
      return axes;
    }

    /// The reduced swimmer's curve of displacement against frequency, with the full-order model's points on it.
    void sweep_and_draw(const Scene &scene, const CommonOptions &common)
    {
      const ReducedModel model   = read_reduced_model(find_model("reference-2d"));
      SweepOptions       options = sweep_options(scene, model);
      options.periodic = options.indicator   = false;
      const auto                     start   = std::chrono::steady_clock::now();
      const std::vector<SweepResult> results = sweep(model, axes_of_curve(), options);
      const double wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const std::vector<FrequencyCurve> curves = curves_of(results);

      const auto pictures = draw_beside_results(
          common.output,
          {frequency_picture(curves, "reduced swimmer",
                             {"full order, without inertia", full_order_curves(scene.head.magnetization_A_m)})},
          common.command_line);
      if (common.quiet)
        return;
      say("\nThe reduced swimmer, trained once, repeats such a run in milliseconds: {} runs, of three stiffnesses at "
          "60 frequencies, in {:.2g} s.\n{}",
          results.size(), wall_time_s, model_card(model));
      for (const auto &picture : pictures)
        say("  picture {}\n", picture.string());
    }

    CommonOptions in_folder(const CommonOptions &common, const char *name)
    {
      CommonOptions inside = common;
      inside.output        = common.output / name;
      inside.overrides.clear();
      return inside;
    }

    /// Fit the swimmer to shipped data, which are synthetic.
    void fit(const CommonOptions &common)
    {
      if (!common.quiet)
        say("\nA fit to twelve noisy displacements (synthetic, made by the full-order model without inertia, with E/mu "
            "= 52632 1/s "
            "and M/mu = 131579 A/(m Pa s)):\n");
      CalibrateCommand command;
      command.common  = in_folder(common, "fit");
      command.model   = "reference-2d";
      command.problem = shipped_file("problems/two-ratios.toml").string();
      command.data    = {shipped_file("observations/synthetic-soft.csv").string()};
      calibrate_and_report(command);
    }

    /// The fastest field within the limits of the coils, replayed. Collective.
    void plan_and_replay(const CommonOptions &common)
    {
      if (is_speaker() && !common.quiet)
        say("\nThe field that swims fastest, no stronger than the study's, and its proof on the full-order model:\n");
      OptimizeCommand command;
      command.common                  = in_folder(common, "fastest-field");
      command.model                   = "reference-2d";
      command.goal                    = shipped_file("goals/fastest-straight-quick.toml").string();
      command.with_replay             = true;
      command.replay.steps_per_period = 100;
      optimize_and_report(command);
    }

    /// Collective.
    void show(const Scene &scene, const CommonOptions &common, const Begun &begun)
    {
      if (is_speaker() && !common.quiet)
        say("The reference study's elastic magneto-swimmer (scene {}): a rigid magnetic head of {} x {} mm pulls a\n"
            "tapered elastic tail of {} mm through glycerol, driven at {:.2g} Hz.\n",
            scene.name, 1e3 * scene.head.size_m[0], 1e3 * scene.head.size_m[1], 1e3 * scene.tail->length_m,
            1. / scene.time.period_s);
      SimulateOptions options;
      options.pictures = true;
      simulate_and_report(scene, common, options);
      begun();
      if (is_speaker())
      {
        sweep_and_draw(scene, common);
        fit(common);
      }
      plan_and_replay(common);
    }
  } // namespace

  Work add_demo(CLI::App &tool, const std::string &command_line)
  {
    auto  common = std::make_shared<CommonOptions>();
    auto *verb   = tool.add_subcommand(
          "demo", "Watch the reference study's swimmer swim, then at 60 frequencies; fit it; make it faster");
    add_common_options(*verb, *common, OutputFolder::required);
    common->scene        = "reference-2d-casefile";
    common->command_line = command_line;
    return [common] {
      const Scene scene = load_scene(*common);
      require_full_order_model("demo", RanksAtWork::all);
      work_in_folder_together(output_request(*common, written_by::demo(), {}),
                              [&](const Begun &begun) { show(scene, *common, begun); });
    };
  }
} // namespace swimtwin
