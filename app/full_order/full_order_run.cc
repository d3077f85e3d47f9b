#include <app/full_order/full_order_run.h>

#include <fom/run/simulation.h>

namespace swimtwin
{
  double full_order_displacement_m(const Scene &scene, const std::filesystem::path &folder)
  {
    std::filesystem::create_directories(folder);
    SimulationOptions options;
    options.folder = folder;
    return simulate(scene, options, MPI_COMM_SELF).summary.net_displacement_m;
  }
} // namespace swimtwin
