// Inertia of fluid and tail at shapes of a trained swimmer, shared out over ranks.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <fom/resistance/motion_inertia.h>
#include <rom/training/sample_store.h>

#include <functional>
#include <vector>

namespace swimtwin
{
  /// Of one material at unit density, as ReducedInertia has it: M, and the quadratic forces N_i beside half of dM/dt.
  struct InertiaSample
  {
    Eigen::MatrixXd mass;      ///< n x n
    Eigen::MatrixXd quadratic; ///< row i: entries (j, k), k <= j, of N_i as coefficients of xi_j xi_k
  };

  struct InertiaSamples
  {
    std::vector<ShapePoint>    points;
    std::vector<InertiaSample> fluid, tail;
    double                     largest_power_defect = 0.; ///< MotionInertia::power_defect of the fluid
  };

  /// At the shapes and poses of the model of a scene in `dim` dimensions, without those that cannot be meshed.
  /// `model.tail` and `model.resistance` are needed. Collective.
  template <int dim>
  InertiaSamples sample_inertia(const ReducedModel &model, const Scene &scene, const std::vector<ShapePoint> &points,
                                MPI_Comm communicator, const std::function<void(int, int)> &on_progress = {});
} // namespace swimtwin
