// What a run left in its folder, read back.
#pragma once

#include <datasets/run/plane_flow.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/scene.h>

#include <filesystem>
#include <optional>
#include <string>

namespace swimtwin
{
  struct RunFolder
  {
    std::string                name; ///< of the folder
    RunRecord                  record;
    std::optional<Scene>       scene;      ///< of the provenance; absent if this program cannot read it
    Trajectory                 trajectory; ///< empty when the run failed: what lies there is of an earlier one
    std::optional<SnapshotSet> snapshots;
    std::vector<PlaneFlow>     flows;   ///< empty without a fluid that was solved for, and of earlier versions
    std::string                warning; ///< what is absent and why, one sentence; empty when all is there
  };

  bool is_run(const std::filesystem::path &folder);

  bool has_completed(const RunSummary &summary);

  /// The last part of a path, also of "." and "runs/".
  std::string folder_name(const std::filesystem::path &folder);

  /// summary.json alone, with its scene. Throws InputError naming file and entry.
  RunFolder read_run_record(const std::filesystem::path &folder);

  /// With trajectory.csv and, if they are there, snapshots.h5 and flow.h5. Throws InputError naming the file that is
  /// wrong.
  RunFolder read_run(const std::filesystem::path &folder);
} // namespace swimtwin
