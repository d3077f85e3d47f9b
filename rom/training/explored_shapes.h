// Where the reduced swimmer itself goes, over the whole range it is to be trained for.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/integration/swimmer_run.h>
#include <rom/swimmer/reduced_swimmer.h>
#include <rom/training/sampled_shapes.h>
#include <rom/training/training_runs.h>

namespace swimtwin
{
  /// n members of the range, spread evenly (Halton points from `first` on); ranges above zero are spread by ratio.
  std::vector<RunParameters> spread_members(const TrainedRange &range, int n, int first = 1);

  /// Three periods of a member from rest; all else is the scene's.
  RunRequest request_of(const RunParameters &member, const Scene &scene, const ReducedSwimmer &swimmer);

  struct ExploredPoint
  {
    ShapePoint      shape;
    Eigen::VectorXd velocity; ///< R^T dx/dt, omega, dq/dt
  };

  /// The model's own trajectories of three periods; the angle is that of `rest` if nothing depends on it. A run that
  /// fails adds what it reached.
  std::vector<ExploredPoint> explore(const ReducedModel &model, const Scene &scene,
                                     const std::vector<RunParameters> &members, const ShapePoint &rest);
  std::vector<ShapePoint>    shapes_of(const std::vector<ExploredPoint> &points);
} // namespace swimtwin
