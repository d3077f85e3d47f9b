// Whether the resistance depends on where the swimmer is and how it is turned.
#pragma once

#include <rom/training/sampled_shapes.h>

namespace swimtwin
{
  /// Largest relative change of the resistance, for any motion.
  struct PoseDependence
  {
    double on_angle  = 0.; ///< over the angles of the region
    double on_way    = 0.; ///< over the distance that the runs went along x
    double on_height = 0.; ///< over the heights above and below the usual one
  };

  /// Samples some shapes turned and moved. In a domain that moves with the swimmer there is nothing to measure.
  /// `reach_m` is how far the runs went along x, and from the usual height. Collective.
  PoseDependence measure_pose_dependence(const std::vector<ShapePoint> &shapes, const SampledRegion &region,
                                         const ShapePoint &rest, const Eigen::Vector2d &reach_m, ShapeSampler &sampler);
} // namespace swimtwin
