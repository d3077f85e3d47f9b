// Which shapes the resistance is sampled at.
#pragma once

#include <rom/training/sampled_region.h>

namespace swimtwin
{
  /// Points of the runs' trajectories, in the coordinates of a basis, without drift.
  std::vector<ShapePoint> trajectory_points(const std::vector<SnapshotSet> &sets, const TailBasis &basis,
                                            const TailSpace &space);

  struct Wandering
  {
    UsualPlace      usual;
    Eigen::Vector2d reach_m;         ///< how far the middle went along x, and the head's height from the usual one
    double          to_and_fro = 0.; ///< half of the head's path over how far it got, of a typical run
  };

  /// From runs, whose points are those of the snapshots in the same order; sets their heights. The head is at rest at
  /// height zero.
  template <int dim>
  Wandering wandering(const std::vector<SnapshotSet> &sets, const Swimmer<dim> &swimmer,
                      std::vector<ShapePoint> &points);

  /// The region that holds all points, widened by `margin`. No coordinate's scale is below a hundredth of the largest
  /// one's, so that round-off in modes that hardly move cannot leave it.
  SampledRegion region_around(const std::vector<ShapePoint> &points, double margin);

  /// The rest shape, then one point at the region's edge per variable.
  std::vector<ShapePoint> axis_points(const SampledRegion &region, const ShapePoint &rest);

  /// A space-filling set: Halton points in the ball of shapes times the interval of angles.
  std::vector<ShapePoint> filling_points(const SampledRegion &region, const ShapePoint &rest, int n);

  /// The k-th point of van der Corput's sequence: in (0, 1), spread evenly for every k.
  double halton(int k, int base);

  /// n of the candidates, each farthest from all chosen before and from `taken`; distances are weighted by effects.
  std::vector<ShapePoint> spread_out(const std::vector<ShapePoint> &candidates, const std::vector<ShapePoint> &taken,
                                     const SampledRegion &region, const Eigen::VectorXd &effects, int n);
} // namespace swimtwin
