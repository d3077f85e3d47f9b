#include <rom/training/sampled_region.h>

namespace swimtwin
{
  Eigen::VectorXd SampledRegion::variables(const ShapePoint &point) const
  {
    Eigen::VectorXd z(n_variables());
    z.head(point.q.size()) = point.q.cwiseQuotient(coordinate_scale_m);
    if (depends_on_angle)
      z(point.q.size()) = point.angle_rad / angle_scale_rad;
    if (depends_on_height)
      z(z.size() - 1) = point.drift_y_m / height_scale_m;
    return z;
  }
} // namespace swimtwin
