// A run of the full-order model, with its report.
#include <app/full_order/simulation_report.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/progress_bar.h>
#include <app/frame/ranks.h>
#include <app/frame/written_files.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <fom/run/simulation.h>
#include <reports/run/draw_run.h>
#include <reports/run/simulation_report.h>

#include <fmt/format.h>

#include <memory>
#include <optional>

namespace swimtwin
{
  namespace
  {
    /// Whether the folder holds all results of this very scene. Throws InputError if they are of another one.
    bool is_complete(const std::filesystem::path &folder, const Scene &scene)
    {
      const auto has = [&](const std::string &name) { return std::filesystem::exists(folder / name); };
      if (has("checkpoint.h5") || !has("trajectory.csv") || !has("summary.json"))
        return false;
      if (read_run_summary_json(folder / "summary.json").provenance.scene_hash != scene.hash)
        throw InputError((folder / "summary.json").string() +
                         " belongs to another scene or to other --set values: choose " +
                         "another --output, or start afresh with --force");
      return has("snapshots.h5") || !scene.tail || scene.output.snapshots_per_period == 0;
    }

    /// Whether a run that is resumed has nothing left to do. Only rank 0 looks at the disk; the others learn it.
    bool nothing_to_resume(const std::filesystem::path &folder, const Scene &scene)
    {
      bool complete = false;
      agree([&] { complete = is_complete(folder, scene); });
      MPI_Bcast(&complete, sizeof complete, MPI_BYTE, 0, MPI_COMM_WORLD);
      return complete;
    }

    void report_run(const Scene &scene, const CommonOptions &common, const bool with_pictures,
                    const SimulationResult &result)
    {
      std::string                        warning;
      std::vector<std::filesystem::path> pictures;
      if (with_pictures)
      {
        std::optional<SnapshotSet> snapshots;
        if (scene.tail)
          snapshots = result.snapshots;
        pictures = draw_run(common.output, scene, result.trajectory, result.summary, snapshots, result.flows, warning);
      }
      for (const std::string &doubt : result.summary.warnings)
        warn(doubt);
      if (!warning.empty())
        remark(warning);
      if (common.quiet)
        return;
      say_text(describe(scene, result.summary));
      say("  results in {}\n", common.output.string());
      for (const auto &picture : pictures)
        say("  picture {}\n", picture.string());
    }

    void simulate_in_folder(const Scene &scene, const CommonOptions &common, const SimulateOptions &own,
                            const Begun &begun)
    {
      if (own.resume && nothing_to_resume(common.output, scene))
      {
        if (is_speaker() && !common.quiet)
          say("{} is complete: nothing to resume\n", common.output.string());
        return;
      }
      SimulationOptions options;
      options.folder       = common.output;
      options.command_line = common.command_line;
      options.resume       = own.resume;
      auto bar             = std::make_unique<ProgressBar>(common.quiet || !is_speaker());
      options.on_progress  = [&](const SimulationProgress &p) {
        begun();
        bar->show(p.steps_done, p.steps_total, p.steps_done_here, p.wall_time_s);
      };
      const auto result = simulate(scene, options, MPI_COMM_WORLD);
      bar.reset();
      if (is_speaker())
        report_run(scene, common, own.pictures, result);
    }
  } // namespace

  void simulate_and_report(const Scene &scene, const CommonOptions &common, const SimulateOptions &own)
  {
    OutputRequest request = output_request(common, written_by::simulate(), files_of(common, scene));
    request.resume        = own.resume;
    work_in_folder_together(request, [&](const Begun &begun) { simulate_in_folder(scene, common, own, begun); });
  }
} // namespace swimtwin
