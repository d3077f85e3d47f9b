// The flow around a reduced run: by the full-order fluid where this build has it.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/run/plane_flow.h>
#include <datasets/scene/scene.h>
#include <rom/integration/swimmer_run.h>

#include <filesystem>
#include <functional>
#include <vector>

namespace swimtwin
{
  /// Write it for ParaView, one instant per snapshot; returns it in the plane of motion at some of them, for flow.h5.
  /// Throws InputError in a build without finite elements.
  std::vector<PlaneFlow> write_flow_of_run(const Scene &scene, const ReducedModel &model, const RunRequest &request,
                                           const std::vector<ReducedSnapshot>    &snapshots,
                                           const std::filesystem::path           &folder,
                                           const std::function<void(int n_done)> &on_progress);
} // namespace swimtwin
