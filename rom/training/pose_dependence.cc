#include <rom/training/pose_dependence.h>

#include <rom/swimmer/dense_algebra.h>
#include <rom/training/factor_entries.h>

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
    // Without a mirror both ways count, and a pose that cannot be, in a wall, says that the wall is felt.
    const auto change_to_and_fro = [&](const ShapePoint &from, const ShapePoint &to, const ShapePoint &opposite) {
      if (region.has_mirror)
        return change(from, to);
      const auto at = sampler.sample({from}), moved = sampler.sample({to, opposite});
      if (at.empty())
        return 0.;
      if (moved.size() < 2)
        return 1.;
      const auto by = [&](const ResistanceSample &sample) {
        return relative_change(at.front().resistance, sample.resistance);
      };
      return std::max(by(moved[0]), by(moved[1]));
    };
    for (const auto &shape : shapes)
    {
      ShapePoint straight = rest;
      straight.q          = shape.q;
      ShapePoint turned = straight, turned_back = straight;
      turned.angle_rad      = region.angle_scale_rad;
      turned_back.angle_rad = -region.angle_scale_rad;
      dependence.on_angle   = std::max(dependence.on_angle, change_to_and_fro(straight, turned, turned_back));
      ShapePoint along      = straight;
      along.drift_x_m       = -reach_m[0]; // head first
      dependence.on_way     = std::max(dependence.on_way, change(straight, along));
      ShapePoint above = straight, below = straight;
      above.drift_y_m      = reach_m[1];
      below.drift_y_m      = -reach_m[1];
      dependence.on_height = std::max(dependence.on_height, change_to_and_fro(straight, above, below));
    }
    return dependence;
  }
} // namespace swimtwin
