// What a run will do and cost, before it is started.
#pragma once

#include <datasets/scene.h>

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
  };

  /// Unsteady group 2 pi rho f L^2 / mu: inertia of the fluid against viscosity over one period.
  double unsteady_group(const Scene &scene);
  /// A sentence if inertia is neglected without the scene having said so, and is not small; else empty.
  std::string inertia_warning(const Scene &scene);
  /// Magnetic torque against the viscous torque of a turn per period: M A B / (mu f L^2), and the elastic group
  /// E h^3 / (12 (1 - nu^2) mu f L^3) with the tail's mean height h. Zero where the scene lacks what they need.
  double magnetic_group(const Scene &scene);
  double elastic_group(const Scene &scene);

  /// Meshes the scene, solves nothing. Collective.
  RunPlan plan_run(const Scene &scene, MPI_Comm communicator);
} // namespace swimtwin
