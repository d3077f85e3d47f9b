#include <app/full_order/flow_output.h>

#include <rom/training/flow_reconstruction.h>

namespace swimtwin
{
  void write_flow_of_run(const Scene &scene, const ReducedModel &model, const double frequency_Hz,
                         const std::vector<ReducedSnapshot> &snapshots, const std::filesystem::path &folder,
                         const std::function<void(int)> &on_progress)
  {
    write_flow(scene, model, frequency_Hz, snapshots, folder, on_progress);
  }
} // namespace swimtwin
