// What a run will do and cost, before it is started.
#pragma once

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/scene.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace swimtwin
{
  struct PlanItem
  {
    std::string what, why;
  };

  struct RunPlan
  {
    std::vector<PlanItem>    solved, skipped, numbers;
    std::vector<std::string> warnings;
    unsigned int             n_fluid_cells = 0, n_tail_cells = 0, n_unknowns = 0;
    double                   mesh_quality = 1., estimated_time_s = 0., estimated_memory_MB = 0.;
    bool                     is_extrapolated = false; ///< the estimates, beyond the sizes that were measured
  };

  /// Meshes the scene, solves nothing. Collective.
  RunPlan plan_run(const Scene &scene, MPI_Comm communicator);
} // namespace swimtwin
