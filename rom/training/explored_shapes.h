// Where the reduced swimmer itself goes, over the whole range it is to be trained for.
#pragma once

#include <datasets/reduced_model.h>
#include <rom/training/sampled_shapes.h>
#include <rom/training/training_runs.h>

namespace swimtwin
{
  /// n members of the range, spread evenly (Halton points from `first` on); ranges above zero are spread by ratio.
  std::vector<RunParameters> spread_members(const TrainedRange &range, int n, int first = 1);

  /// Shapes and angles on the model's own trajectories of three periods; without drift; the
  /// angle is that of `rest` if nothing depends on it. A run that fails adds what it reached.
  std::vector<ShapePoint> explored_points(const ReducedModel &model, const std::vector<RunParameters> &members,
                                          const ShapePoint &rest);

  /// Largest |z| and |angle| / scale of points, 1 at the region's edge.
  double largest_radius(const std::vector<ShapePoint> &points, const SampledRegion &region);
} // namespace swimtwin
