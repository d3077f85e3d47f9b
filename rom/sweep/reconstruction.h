// The whole tail from its modes' coordinates.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/run/snapshot_set.h>
#include <rom/integration/swimmer_run.h>

#include <vector>

namespace swimtwin
{
  /// Displacement (m) of the tail's nodes in the head's frame, interleaved components.
  Eigen::VectorXd tail_displacement(const ReducedTail &tail, const ShapeVector &q);

  /// Its rate (m/s) when the coordinates change at the given rate: followers move as the shape says.
  Eigen::VectorXd tail_velocity(const ReducedTail &tail, const ShapeVector &q, const ShapeVector &rate);

  /// Positions (m) of the tail's nodes in the laboratory, n_nodes x dimension.
  Eigen::MatrixXd tail_positions(const ReducedTail &tail, const SwimmerState &state);

  /// Shapes of the whole tail as the full-order model records them. Nodes where all modes vanish count as clamped.
  SnapshotSet reconstruct(const ReducedTail &tail, const Drive &drive, const std::vector<ReducedSnapshot> &snapshots);
} // namespace swimtwin
