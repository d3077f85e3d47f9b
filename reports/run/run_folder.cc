#include <reports/run/run_folder.h>

#include <datasets/system/error.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    void read_scene_of_record(RunFolder &run)
    {
      try
      {
        run.scene = parse_scene(run.record.provenance.scene_text, fmt::format("{}.toml", run.name));
      }
      catch (const InputError &error)
      {
        run.warning =
            fmt::format("The scene of {} cannot be read, so that what needs it is absent; if it names a field "
                        "program or a surface, make the page from the folder of the scene: {}",
                        run.name, error.what());
      }
    }
  } // namespace

  bool is_run(const fs::path &folder)
  {
    std::error_code unreadable;
    return fs::exists(folder / "summary.json", unreadable);
  }

  bool has_completed(const RunSummary &summary)
  {
    return summary.status == "completed";
  }

  std::string folder_name(const fs::path &folder)
  {
    const fs::path whole = fs::weakly_canonical(folder);
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  }

  RunFolder read_run_record(const fs::path &folder)
  {
    RunFolder run;
    run.name   = folder_name(folder);
    run.record = read_run_summary_json(folder / "summary.json");
    read_scene_of_record(run);
    return run;
  }

  RunFolder read_run(const fs::path &folder)
  {
    RunFolder run = read_run_record(folder);
    if (!has_completed(run.record.summary))
      return run;
    if (const fs::path file = folder / "trajectory.csv"; fs::exists(file))
      run.trajectory = read_trajectory_csv(file);
    else
      run.warning =
          fmt::format("There are no pictures because {} is missing; simulate again with --force.", file.string());
    const bool has_snapshots = run.scene && run.scene->tail && run.scene->output.snapshots_per_period > 0;
    if (const fs::path file = folder / "snapshots.h5"; has_snapshots && fs::exists(file))
      run.snapshots = read_snapshots(file);
    if (const fs::path file = folder / "flow.h5"; run.scene && fs::exists(file))
      run.flows = read_plane_flows(file);
    return run;
  }
} // namespace swimtwin
