// The region of shapes and poses in which a resistance is sampled.
#pragma once

#include <rom/training/shape_sampler.h>

namespace swimtwin
{
  /// The region of shapes and poses that is sampled: |q / scale| <= 1, |angle| <= angle_scale, and height above the
  /// usual one |drift_y| <= height_scale.
  struct SampledRegion
  {
    Eigen::VectorXd coordinate_scale_m;
    bool            depends_on_angle  = false;
    double          angle_scale_rad   = 1.;
    bool            depends_on_height = false;
    double          height_scale_m    = 1.;
    bool            has_mirror        = true; ///< whether a mirrored swimmer feels the mirrored resistance

    int n_variables() const
    {
      return static_cast<int>(coordinate_scale_m.size()) + depends_on_angle + depends_on_height;
    }
    Eigen::VectorXd variables(const ShapePoint &point) const; ///< z, then scaled angle and height if they matter
  };
} // namespace swimtwin
