#include <app/full_order/flow_output.h>

#include <rom/training/flow_reconstruction.h>

namespace swimtwin
{
  std::vector<PlaneFlow> write_flow_of_run(const Scene &scene, const ReducedModel &model, const RunRequest &request,
                                           const std::vector<ReducedSnapshot> &snapshots,
                                           const std::filesystem::path        &folder,
                                           const std::function<void(int)>     &on_progress)
  {
    return write_flow(scene, model, request, snapshots, folder, on_progress);
  }
} // namespace swimtwin
