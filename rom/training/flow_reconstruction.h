// The flow around a reduced swimmer, by the full-order fluid.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/run/plane_flow.h>
#include <rom/integration/swimmer_run.h>

#include <filesystem>
#include <functional>
#include <vector>

namespace swimtwin
{
  /// Write the fluid and the tail at every snapshot for ParaView (fom/field_output.h): each body is meshed and one
  /// Stokes problem solved around it, as it moves there. Returns the flow in the plane of motion at some of the last
  /// period's (is_flow_instant in fom/run/flow_in_plane.h). The scene is the model's, with the run's viscosity. Throws
  /// InputError if the scene makes another tail than the model's, ComputationError if a body cannot be meshed.
  std::vector<PlaneFlow> write_flow(const Scene &scene, const ReducedModel &model, const RunRequest &request,
                                    const std::vector<ReducedSnapshot> &snapshots, const std::filesystem::path &folder,
                                    const std::function<void(int n_done)> &on_progress = {});
} // namespace swimtwin
