#include <rom/training/sampled_shapes.h>

#include <fom/elastic/nodal_vector.h>
#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swimtwin
{
  std::vector<ShapePoint> trajectory_points(const std::vector<SnapshotSet> &sets, const TailBasis &basis,
                                            const TailSpace &space)
  {
    std::vector<ShapePoint> points;
    for (const auto &set : sets)
    {
      const Eigen::MatrixXd q = basis.coordinates_of(space, set.tail_displacement_m.transpose());
      for (Eigen::Index k = 0; k < q.cols(); ++k)
        points.push_back({q.col(k), set.pose(k, 2), 0., 0.});
    }
    return points;
  }

  namespace
  {
    /// How far the middle went along x since the start.
    template <int dim>
    double reach_along_x(const std::vector<SnapshotSet> &sets, const Swimmer<dim> &swimmer)
    {
      double reach = 0.;
      for (const auto &set : sets)
      {
        const auto middle = [&](const Eigen::Index k) {
          RigidPose<dim> pose;
          pose.center[0] = set.pose(k, 0);
          pose.center[1] = set.pose(k, 1);
          pose.set_attitude(Attitude<dim>::about_z(set.pose(k, 2)));
          return pose.to_laboratory(
              swimmer.arm_to_middle(nodal_field<dim>(set.tail_displacement_m.row(k).transpose())))[0];
        };
        for (Eigen::Index k = 0; k < set.pose.rows(); ++k)
          reach = std::max(reach, std::abs(middle(k) - middle(0)));
      }
      return reach;
    }

    /// Half of the head's path over how far it got: the median over runs, some of which may get nowhere.
    double to_and_fro(const std::vector<SnapshotSet> &sets)
    {
      std::vector<double> ratios;
      for (const auto &set : sets)
      {
        const Eigen::Index n    = set.pose.rows() - 1;
        const double       path = (set.pose.bottomRows(n) - set.pose.topRows(n)).leftCols<2>().rowwise().norm().sum();
        const double       way  = (set.pose.bottomRows<1>() - set.pose.topRows<1>()).leftCols<2>().norm();
        ratios.push_back(path > 0. ? .5 * path / way : 0.);
      }
      const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
      std::nth_element(ratios.begin(), middle, ratios.end());
      return *middle;
    }
  } // namespace

  template <int dim>
  Wandering wandering(const std::vector<SnapshotSet> &sets, const Swimmer<dim> &swimmer,
                      std::vector<ShapePoint> &points)
  {
    // What swings and bends push the head sideways, told apart from where a run began, turned perhaps, and from how it
    // went across since: an offset and a slope of every run's own. Heights that the snapshots do not tell stay at zero:
    // their damping is a ten-thousandth of what they tell best.
    constexpr double   damping = 1e-4;
    const auto         m       = static_cast<Eigen::Index>(points.size());
    const Eigen::Index r = points.front().q.size(), n = r + 1 + 2 * static_cast<Eigen::Index>(sets.size());
    const double       length = swimmer.scene().body_length_m(), rest_m = swimmer.pose_at_rest().center[1];
    Eigen::VectorXd    heights = Eigen::VectorXd::Zero(m + n);
    Eigen::MatrixXd    A       = Eigen::MatrixXd::Zero(m + n, n);
    Eigen::Index       row = 0, own = r + 1;
    for (const auto &set : sets)
    {
      const auto last = static_cast<double>(std::max<Eigen::Index>(1, set.pose.rows() - 1));
      for (Eigen::Index k = 0; k < set.pose.rows(); ++k, ++row)
      {
        A.row(row).head(r + 1) << std::sin(points[row].angle_rad), points[row].q.transpose() / length;
        A.row(row).segment<2>(own) << 1., static_cast<double>(k) / last;
        heights(row) = set.pose(k, 1) - rest_m;
      }
      own += 2;
    }
    A.bottomRows(n)             = damping * A.topLeftCorner(m, r + 1).norm() * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd found = solve_by_qr(A, heights);

    Wandering result{{found(0), found.segment(1, r) / length}, {reach_along_x(sets, swimmer), 0.}, to_and_fro(sets)};
    for (Eigen::Index k = 0; k < m; ++k)
    {
      points[k].drift_y_m = heights(k) - result.usual.height_m(points[k]);
      result.reach_m[1]   = std::max(result.reach_m[1], std::abs(points[k].drift_y_m));
    }
    return result;
  }

  template Wandering wandering<2>(const std::vector<SnapshotSet> &, const Swimmer<2> &, std::vector<ShapePoint> &);
  template Wandering wandering<3>(const std::vector<SnapshotSet> &, const Swimmer<3> &, std::vector<ShapePoint> &);

  SampledRegion region_around(const std::vector<ShapePoint> &points, const double margin)
  {
    constexpr double smallest_share = 0.004;
    SampledRegion    region;
    region.coordinate_scale_m = Eigen::VectorXd::Zero(points.front().q.size());
    region.angle_scale_rad    = 0.;
    region.height_scale_m     = 0.;
    for (const auto &point : points)
    {
      region.coordinate_scale_m = region.coordinate_scale_m.cwiseMax(point.q.cwiseAbs());
      region.angle_scale_rad    = std::max(region.angle_scale_rad, margin * std::abs(point.angle_rad));
      region.height_scale_m     = std::max(region.height_scale_m, margin * std::abs(point.drift_y_m));
    }
    region.coordinate_scale_m =
        region.coordinate_scale_m.cwiseMax(smallest_share * region.coordinate_scale_m.maxCoeff()).eval();
    double radius = 0.;
    for (const auto &point : points)
      radius = std::max(radius, point.q.cwiseQuotient(region.coordinate_scale_m).norm());
    region.coordinate_scale_m *= margin * radius;
    if (region.height_scale_m == 0.)
      region.height_scale_m = 1.; // nothing drifts, so that any unit does
    return region;
  }

  std::vector<ShapePoint> axis_points(const SampledRegion &region, const ShapePoint &rest)
  {
    std::vector<ShapePoint> points{rest};
    for (Eigen::Index i = 0; i < region.coordinate_scale_m.size(); ++i)
    {
      points.push_back(rest);
      points.back().q(i) = region.coordinate_scale_m(i);
    }
    if (region.depends_on_angle)
    {
      points.push_back(rest);
      points.back().angle_rad = region.angle_scale_rad;
    }
    if (region.depends_on_height)
    {
      points.push_back(rest);
      points.back().drift_y_m = region.height_scale_m;
    }
    return points;
  }

  double halton(int k, const int base)
  {
    double value = 0., digit = 1. / base;
    for (; k > 0; k /= base, digit /= base)
      value += digit * (k % base);
    return value;
  }

  std::vector<ShapePoint> filling_points(const SampledRegion &region, const ShapePoint &rest, const int n)
  {
    constexpr std::array    primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    constexpr double        weight_of_filling = .3;
    const Eigen::Index      r                 = rest.q.size();
    std::vector<ShapePoint> points;
    for (int k = 1; static_cast<int>(points.size()) < n; ++k)
    {
      // Directions from Gaussian-like sums would cluster; a cube's points, pulled radially onto the ball, fill it.
      Eigen::VectorXd z(r);
      for (Eigen::Index i = 0; i < r; ++i)
        z(i) = 2. * halton(k, primes[i % primes.size()]) - 1.;
      const double length = z.norm();
      if (length == 0.)
        continue;
      z *= z.cwiseAbs().maxCoeff() / length;
      points.push_back(rest);
      points.back().weight = weight_of_filling;
      points.back().q      = z.cwiseProduct(region.coordinate_scale_m);
      if (region.depends_on_angle)
        points.back().angle_rad = region.angle_scale_rad * (2. * halton(k, primes[r % primes.size()]) - 1.);
      if (region.depends_on_height)
        points.back().drift_y_m = region.height_scale_m * (2. * halton(k, primes[(r + 1) % primes.size()]) - 1.);
    }
    return points;
  }

  std::vector<ShapePoint> spread_out(const std::vector<ShapePoint> &candidates, const std::vector<ShapePoint> &taken,
                                     const SampledRegion &region, const Eigen::VectorXd &effects, const int n)
  {
    std::vector<Eigen::VectorXd> place;
    std::vector<double>          distance(candidates.size(), std::numeric_limits<double>::infinity());
    for (const auto &point : candidates)
      place.push_back(region.variables(point).cwiseProduct(effects));
    const auto withdraw_from = [&](const Eigen::VectorXd &centre) {
      for (std::size_t k = 0; k < place.size(); ++k)
      {
        distance[k] = std::min(distance[k], (place[k] - centre).norm());
        if (region.has_mirror) // the mirror image of a sample is as good as the sample
          distance[k] = std::min(distance[k], (place[k] + centre).norm());
      }
    };
    for (const auto &point : taken)
      withdraw_from(region.variables(point).cwiseProduct(effects));
    std::vector<ShapePoint> chosen;
    while (static_cast<int>(chosen.size()) < std::min<int>(n, candidates.size()))
    {
      const auto farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
      chosen.push_back(candidates[farthest]);
      withdraw_from(place[farthest]);
    }
    return chosen;
  }
} // namespace swimtwin
