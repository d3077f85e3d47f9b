// A whole run: step, record, checkpoint, write.
#pragma once

#include <datasets/run/plane_flow.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/scene.h>

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

namespace swimtwin
{
  struct SimulationProgress
  {
    int    steps_done, steps_total;
    double wall_time_s;     ///< since the start of this process's part of the run
    int    steps_done_here; ///< without those done before a resume
  };

  struct SimulationOptions
  {
    std::filesystem::path                           folder; ///< exists; nothing is written elsewhere
    std::string                                     command_line;
    bool                                            resume     = false; ///< go on from checkpoint.h5, if there is one
    bool                                            keeps_flow = true;  ///< for flow.h5
    std::function<void(const SimulationProgress &)> on_progress;
  };

  struct SimulationResult
  {
    Trajectory             trajectory;
    RunSummary             summary;
    SnapshotSet            snapshots; ///< empty without a tail
    std::vector<PlaneFlow> flows;     ///< of rank 0; empty without a fluid
  };

  /// Run a scene and write trajectory.csv, summary.json, snapshots.h5 (with a tail), flow.h5 (with a fluid, if kept)
  /// and, when the scene asks, fields/. Results take their names when the run is complete; until then only
  /// checkpoint.h5 grows. If the computation fails, summary.json says why, the checkpoint stays, and the
  /// ComputationError is passed on. Collective.
  SimulationResult simulate(const Scene &scene, const SimulationOptions &options, MPI_Comm communicator);
} // namespace swimtwin
