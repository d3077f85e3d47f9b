// Where the reduced swimmer itself goes, over the whole range it is to be trained for.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/swimmer_parameters.h>
#include <rom/training/sampled_shapes.h>
#include <rom/training/training_runs.h>

namespace swimtwin
{
  /// n members of the range, spread evenly (Halton points from `first` on); ranges above zero are spread by ratio.
  std::vector<RunParameters> spread_members(const TrainedRange &range, int n, int first = 1);

  struct ExploredPoint
  {
    ShapePoint      shape;
    Eigen::VectorXd velocity; ///< R^T dx/dt, omega, dq/dt
  };

  /// The model's own trajectories of three periods; the angle is that of `rest` if nothing depends on it. A run that
  /// fails adds what it reached.
  std::vector<ExploredPoint> explore(const ReducedModel &model, const std::vector<RunParameters> &members,
                                     const ShapePoint &rest);
  std::vector<ShapePoint>    shapes_of(const std::vector<ExploredPoint> &points);

  /// Way (m, laboratory) of the head in the third period from rest, a column for each member; NaN where a run fails.
  Eigen::Matrix2Xd third_ways(const ReducedModel &model, const std::vector<RunParameters> &members,
                              const InertialDensities &densities = {});
  /// How far apart ways are: root mean square, relative to the second ones' length, or a twentieth of the longest.
  double relative_difference(const Eigen::Matrix2Xd &ways, const Eigen::Matrix2Xd &others);
} // namespace swimtwin
