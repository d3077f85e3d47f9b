#include <app/frame/written_files.h>

#include <calibration/run/fitted_scene.h>
#include <reports/fit/calibration_files.h>
#include <reports/page/illustrated_page.h>
#include <reports/plan/plan_files.h>
#include <reports/plan/track_files.h>
#include <reports/sweep/sweep_files.h>
#include <twin/run/twin_folder.h>

#include <string>

namespace swimtwin
{
  namespace
  {
    constexpr const char *style_name = "pictures/style.gp";

    /// The files of a page with these pictures.
    FilePatterns page_with(const std::vector<std::string> &pictures)
    {
      FilePatterns patterns{page_name, style_name};
      for (const std::string &picture : pictures)
        for (const char *ending : {".png", ".gp", ".dat"})
          patterns.push_back("pictures/" + picture + ending);
      return patterns;
    }

    FilePatterns motion_files()
    {
      return joined({{"trajectory.csv", "summary.json", "snapshots.h5", "flow.h5", "checkpoint.h5", "fields/fluid.pvd",
                      "fields/tail.pvd", "fields/body.pvd", "fields/view.py", "fields/fluid-[0-9]*.vtu",
                      "fields/tail-[0-9]*.vtu", "fields/body-[0-9]*.vtu"},
                     page_with({"trajectory", "angles", "stroke_loop", "power_balance", "shapes", "spatial_view",
                                "flow_in_plane"})});
    }

    FilePatterns training_files()
    {
      return joined({{"model.h5", "model-card.txt", "samples.h5", "samples-[0-9]*-modes.h5", "samples-[0-9]*-runs.h5"},
                     below("runs/run-[0-9]*", motion_files()),
                     below("held-out/[0-9]*-steps/run-[0-9]*", motion_files()),
                     below("held-out-with-inertia/[0-9]*-steps/run-[0-9]*", motion_files())});
    }

    /// Models that were refined, and what they were refined with.
    FilePatterns refined_files()
    {
      return below("refined-[0-9]*", joined({training_files(), {"shapes/[0-9]*.h5"}}));
    }

    FilePatterns fit_files()
    {
      return joined({calibration_file_names(), page_with({"fit", "pairs", "profiles", "waterfall", "next_experiment"}),
                     below("full-order/[0-9]*", motion_files()), refined_files()});
    }

    FilePatterns field_files()
    {
      FilePatterns motions;
      for (const char *name :
           {reference_field_name, tuned_field_name, optimal_field_name, given_field_name, gradient_free_field_name})
        motions.push_back(file_name(name) + ".csv");
      const FilePatterns replays = joined({{field_name, field_period_name}, motion_files()});
      return joined(
          {{plan_name, field_name, field_period_name, track_table_name, track_summary_name, replay_table_name,
            replay_snapshots_name},
           below(motion_folder_name, motions),
           below(replay_folder_name(tuned_field_name), replays),
           below(replay_folder_name(optimal_field_name), replays),
           refined_files(),
           page_with({"field", "hodograph", "head_path", "gains", "trade_off", "trace", "path", "course", "way"})});
    }

    FilePatterns sweep_files()
    {
      return joined({{sweep_table_name, sweep_data_name, sweep_summary_name}, page_with({"displacement_frequency"})});
    }

    /// Pictures of other verbs in the folder are drawn with the same style.
    WrittenFiles with_pictures(const std::string &verb, const FilePatterns &patterns,
                               const std::string &only_when_interrupted = "")
    {
      return {verb, patterns, only_when_interrupted, "", style_name, {"pictures/*.gp"}};
    }

    FilePatterns demo_files()
    {
      return joined({motion_files(), page_with({"displacement_frequency"}), below("fit", fit_files()),
                     below("fastest-field", field_files())});
    }
  } // namespace

  namespace written_by
  {
    const WrittenFiles &simulate()
    {
      static const WrittenFiles files = with_pictures("simulate", motion_files(), "checkpoint.h5");
      return files;
    }

    const WrittenFiles &optimize()
    {
      static const WrittenFiles files = with_pictures("optimize", field_files());
      return files;
    }

    const WrittenFiles &resistance()
    {
      static const WrittenFiles files{"resistance", {"resistance.json"}, "", ""};
      return files;
    }

    const WrittenFiles &train()
    {
      static const WrittenFiles files{"train", training_files(), "", "model.h5"};
      return files;
    }

    const WrittenFiles &sweep()
    {
      static const WrittenFiles files = with_pictures("sweep", sweep_files());
      return files;
    }

    const WrittenFiles &calibrate()
    {
      static const WrittenFiles files = with_pictures("calibrate", fit_files());
      return files;
    }

    const WrittenFiles &report()
    {
      static const WrittenFiles files{"report", {page_name}, "", ""};
      return files;
    }

    const WrittenFiles &plan()
    {
      static const WrittenFiles files{"plan", {"plan.txt"}, "", ""};
      return files;
    }

    const WrittenFiles &demo()
    {
      static const WrittenFiles files = with_pictures("demo", demo_files());
      return files;
    }

    const WrittenFiles &twin()
    {
      static const WrittenFiles files{"twin",
                                      {twin_table_name, twin_log_name, twin_summary_name, alarms_name, proposals_name,
                                       steering_name, twin_state_name, "twin-journal-[0-9]*.jsonl"},
                                      "",
                                      twin_summary_name};
      return files;
    }

    const WrittenFiles &lab()
    {
      static const WrittenFiles files{"lab", {"truth.csv"}, "", ""};
      return files;
    }
  } // namespace written_by

  std::vector<WrittenFiles> all_written_files()
  {
    using namespace written_by;
    return {simulate(), optimize(), resistance(), train(), sweep(), calibrate(),
            report(),   plan(),     demo(),       twin(),  lab()};
  }
} // namespace swimtwin
