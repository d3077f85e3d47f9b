#include <rom/training/pose_dependence.h>

#include <rom/swimmer/dense_algebra.h>
#include <rom/training/resistance_fit.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    double relative_change(const Eigen::MatrixXd &from, const Eigen::MatrixXd &to)
    {
      return seen_from(cholesky_factor(from), to - from).operatorNorm();
    }
  } // namespace

  PoseDependence measure_pose_dependence(const std::vector<ShapePoint> &shapes, const SampledRegion &region,
                                         const ShapePoint &rest, const Eigen::Vector2d &reach_m, ShapeSampler &sampler)
  {
    PoseDependence dependence;
    const auto     change = [&](const ShapePoint &from, const ShapePoint &to) {
      const auto samples = sampler.sample({from, to});
      return samples.size() == 2 ? relative_change(samples[0].resistance, samples[1].resistance) : 0.;
    };
    for (const auto &shape : shapes)
    {
      ShapePoint straight = rest;
      straight.q          = shape.q;
      ShapePoint turned   = straight;
      turned.angle_rad    = region.angle_scale_rad;
      dependence.on_angle = std::max(dependence.on_angle, change(straight, turned));
      for (int c = 0; c < 2; ++c)
      {
        ShapePoint moved                             = straight;
        (c == 0 ? moved.drift_x_m : moved.drift_y_m) = reach_m[c];
        dependence.on_position                       = std::max(dependence.on_position, change(straight, moved));
      }
    }
    return dependence;
  }
} // namespace swimtwin
