#include <app/full_order/full_order_run.h>

#include <datasets/system/error.h>
#include <fom/run/simulation.h>

namespace swimtwin
{
  double full_order_displacement_m(const Scene &scene, const std::filesystem::path &folder)
  {
    std::filesystem::create_directories(folder);
    SimulationOptions options;
    options.folder           = folder;
    const RunSummary summary = simulate(scene, options, MPI_COMM_SELF).summary;
    if (!summary.net_displacement_m)
      throw ComputationError(scene.name + " ends before its first period: there is no displacement to compare with; "
                                          "raise [time] periods to at least 1");
    return *summary.net_displacement_m;
  }
} // namespace swimtwin
