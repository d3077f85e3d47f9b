#include <control/steering/axis_swing.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int n_steps = 20; // per body length

    Eigen::Vector2d point_on_axis(const Pose &pose, const double behind_m)
    {
      return pose.position_m + behind_m * Eigen::Vector2d(std::cos(pose.angle_rad), std::sin(pose.angle_rad));
    }

    AxisPoint swing_of(const double behind_m, const std::vector<PoseInstant> &instants, const Path &path,
                       const double length_m)
    {
      MeanPosition record;
      for (const PoseInstant &i : instants)
        record.add(i.periods, point_on_axis(i.pose, behind_m));
      AxisPoint result{behind_m};
      int       n = 0;
      for (const PoseInstant &i : instants)
      {
        if (i.periods - 0.5 < instants.front().periods || i.periods + 0.5 > instants.back().periods)
          continue;
        const Eigen::Vector2d point = point_on_axis(i.pose, behind_m);
        const PathPlace       place =
            path.nearest(point, std::max(0., i.arc_m - 1.5 * length_m), std::min(path.length_m(), i.arc_m + length_m));
        result.rms_distance_m += (point - place.point_m).squaredNorm();
        result.rms_swing_m += (point - record.mean_at(i.periods + 0.5)).squaredNorm();
        ++n;
      }
      for (double *sum : {&result.rms_distance_m, &result.rms_swing_m})
        *sum = std::sqrt(*sum / n);
      return result;
    }
  } // namespace

  std::vector<AxisPoint> swing_along_axis(const std::vector<PoseInstant> &instants, const Path &path,
                                          const double length_m)
  {
    std::vector<AxisPoint> points;
    if (instants.empty() || instants.back().periods - instants.front().periods < 2.)
      return points;
    for (int i = 0; i <= n_steps; ++i)
      points.push_back(swing_of(i * length_m / n_steps, instants, path, length_m));
    return points;
  }

  AxisPoint least_swinging(const std::vector<AxisPoint> &points)
  {
    const auto       lowest = std::min_element(points.begin() + 1, points.end() - 1,
                                               [](const auto &a, const auto &b) { return a.rms_swing_m < b.rms_swing_m; });
    const AxisPoint *p      = &*lowest;
    const auto       at     = [&](const double AxisPoint::*of, const double t) {
      const auto square = [&](const int i) { return p[i].*of * p[i].*of; };
      return square(0) + 0.5 * (square(1) - square(-1)) * t + 0.5 * (square(1) - 2. * square(0) + square(-1)) * t * t;
    };
    const auto   swing = [&](const double t) { return at(&AxisPoint::rms_swing_m, t); };
    const double slope = 0.5 * (swing(1.) - swing(-1.)), curvature = swing(1.) - 2. * swing(0.) + swing(-1.);
    const double t = curvature > 0. ? std::clamp(-slope / curvature, -1., 1.) : 0.;
    return {p->behind_m + t * (p[1].behind_m - p->behind_m), std::sqrt(std::max(0., at(&AxisPoint::rms_distance_m, t))),
            std::sqrt(std::max(0., swing(t)))};
  }
} // namespace swimtwin
