#include <control/steering/path.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;

    constexpr double corner_rad     = 0.1; // a curve's pieces turn by less
    constexpr int    pieces_of_turn = 360;

    void require_size(const char *what, const double size_m)
    {
      if (!(std::isfinite(size_m) && size_m > 0.))
        throw InputError(fmt::format("{} = {} of a path must be positive.", what, size_m));
    }

    /// An arc from the origin along +x, turning left (sign 1) or right.
    void add_circle(std::vector<Eigen::Vector2d> &points, const double radius_m, const double sign)
    {
      for (int i = points.empty() ? 0 : 1; i <= pieces_of_turn; ++i)
      {
        const double a = 2. * pi * (i % pieces_of_turn) / pieces_of_turn; // ends exactly where it began
        points.emplace_back(radius_m * std::sin(a), sign * radius_m * (1. - std::cos(a)));
      }
    }

    double angle_between(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
      return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
  } // namespace

  Path Path::through(std::vector<Eigen::Vector2d> points_m, const bool closed)
  {
    Path path;
    if (closed && !points_m.empty() && points_m.front() != points_m.back())
      points_m.push_back(points_m.front());
    for (const Eigen::Vector2d &point : points_m)
    {
      if (!point.allFinite())
        throw InputError("a point of the path is not finite.");
      if (path.points_m_.empty() || (point - path.points_m_.back()).norm() > 0.)
        path.points_m_.push_back(point);
    }
    if (path.points_m_.size() < 2)
      throw InputError(fmt::format("a path needs at least two different points, not {}.", path.points_m_.size()));
    path.closed_ = closed;
    path.arc_m_  = {0.};
    for (std::size_t i = 1; i < path.points_m_.size(); ++i)
    {
      const Eigen::Vector2d piece = path.points_m_[i] - path.points_m_[i - 1];
      path.arc_m_.push_back(path.arc_m_.back() + piece.norm());
      path.heading_rad_.push_back(i == 1 ? std::atan2(piece.y(), piece.x())
                                         : path.heading_rad_.back() +
                                               angle_between(path.points_m_[i - 1] - path.points_m_[i - 2], piece));
    }
    return path;
  }

  Path Path::line(const double length_m)
  {
    require_size("length_m", length_m);
    return through({{0., 0.}, {length_m, 0.}});
  }

  Path Path::circle(const double radius_m)
  {
    require_size("radius_m", radius_m);
    std::vector<Eigen::Vector2d> points;
    add_circle(points, radius_m, 1.);
    return through(points, true);
  }

  Path Path::square(const double side_m)
  {
    require_size("side_m", side_m);
    return through({{0., 0.}, {side_m, 0.}, {side_m, side_m}, {0., side_m}}, true);
  }

  Path Path::figure_eight(const double radius_m)
  {
    require_size("radius_m", radius_m);
    std::vector<Eigen::Vector2d> points;
    add_circle(points, radius_m, 1.);
    add_circle(points, radius_m, -1.);
    return through(points, true);
  }

  std::size_t Path::piece(const double arc_m) const
  {
    const auto after = std::upper_bound(arc_m_.begin(), arc_m_.end(), arc_m);
    const auto index = static_cast<std::size_t>(after - arc_m_.begin());
    return std::clamp<std::size_t>(index, 1, arc_m_.size() - 1) - 1;
  }

  bool Path::is_corner(const std::size_t point) const
  {
    return point > 0 && point + 1 < points_m_.size() &&
           std::abs(heading_rad_[point] - heading_rad_[point - 1]) > corner_rad;
  }

  PathPlace Path::at(const double arc_m) const
  {
    const std::size_t     i       = piece(arc_m);
    const double          heading = heading_rad_[i], s = std::clamp(arc_m, 0., length_m());
    const Eigen::Vector2d tangent(std::cos(heading), std::sin(heading));
    return {s, points_m_[i] + (s - arc_m_[i]) * tangent, tangent, false};
  }

  PathPlace Path::nearest(const Eigen::Vector2d &point_m, const double from_m, const double to_m) const
  {
    PathPlace best     = at(from_m);
    double    distance = (point_m - best.point_m).norm();
    for (std::size_t i = piece(from_m), last = piece(to_m); i <= last; ++i)
    {
      const double          low = std::max(arc_m_[i], from_m), high = std::min(arc_m_[i + 1], to_m);
      const Eigen::Vector2d tangent(std::cos(heading_rad_[i]), std::sin(heading_rad_[i]));
      const double          arc = std::clamp(arc_m_[i] + tangent.dot(point_m - points_m_[i]), low, std::max(low, high));
      const Eigen::Vector2d point = points_m_[i] + (arc - arc_m_[i]) * tangent;
      if ((point_m - point).norm() > distance)
        continue;
      distance = (point_m - point).norm();
      best = {arc, point, tangent, (arc == arc_m_[i] && is_corner(i)) || (arc == arc_m_[i + 1] && is_corner(i + 1))};
    }
    return best;
  }

  double Path::heading_rad(const double arc_m) const
  {
    return heading_rad_[piece(arc_m)];
  }

  double Path::half_turn_rad(const std::size_t point) const
  {
    const bool is_end = point == 0 || point + 1 == points_m_.size();
    if (is_end && !closed_)
      return 0.;
    const double turn = is_end ? std::remainder(heading_rad_.front() - heading_rad_.back(), 2. * pi)
                               : heading_rad_[point] - heading_rad_[point - 1];
    return std::abs(turn) > corner_rad ? 0. : 0.5 * turn;
  }

  double Path::direction_rad(const double arc_m) const
  {
    const std::size_t i    = piece(arc_m);
    const double      part = std::clamp((arc_m - arc_m_[i]) / (arc_m_[i + 1] - arc_m_[i]), 0., 1.);
    return heading_rad_[i] - (1. - part) * half_turn_rad(i) + part * half_turn_rad(i + 1);
  }

  Path Path::placed(const double angle_rad, const Eigen::Vector2d &shift_m) const
  {
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d &point : points_m_)
      points.emplace_back(Eigen::Rotation2Dd(angle_rad) * point + shift_m);
    return through(points, closed_);
  }

  Path Path::first(const double length_m) const
  {
    std::vector<Eigen::Vector2d> points = {points_m_.front()};
    for (std::size_t i = 1; i < points_m_.size() && arc_m_[i] < length_m; ++i)
      points.push_back(points_m_[i]);
    points.push_back(at(length_m).point_m);
    return through(points);
  }

  Path Path::of_front(const double ahead_m) const
  {
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < points_m_.size(); ++i)
    {
      if (is_corner(i))
        throw InputError("a point behind the head cannot be led around a corner; choose a path without corners, or "
                         "lead the head.");
      const double          direction = i == 0 ? direction_rad(0.) : heading_rad_[i - 1] + half_turn_rad(i);
      const Eigen::Vector2d front(std::cos(direction), std::sin(direction));
      points.emplace_back(points_m_[i] + ahead_m * front);
    }
    for (std::size_t i = points.size(); i-- > 0;)
      points[i] -= points[0];
    return through(points);
  }

  PathRequirement path_requirement(const Path &path, const double lever_m, const double heading_rad)
  {
    constexpr double excess_rad =
        0.2; // beyond a right angle: the head misses the path by lever excess^2 / 2, 2 % of the lever
    PathRequirement result;
    double          body = heading_rad;
    const int       n    = static_cast<int>(std::ceil(200. * path.length_m() / lever_m));
    const double    step = path.length_m() / n;
    for (int i = 0; i < n; ++i)
    {
      const double arc    = (i + 0.5) * step;
      const double offset = path.heading_rad(arc) - body;
      if (std::abs(offset) > result.largest_offset_rad)
        result = {true, arc, std::abs(offset)};
      if (result.largest_offset_rad > pi / 2. + excess_rad)
      {
        result.can_be_followed = false;
        return result;
      }
      body += std::sin(offset) / lever_m * step;
    }
    return result;
  }

  void require_followable(const Path &path, const double lever_m)
  {
    const PathRequirement need = path_requirement(path, lever_m, path.heading_rad(0.));
    if (need.can_be_followed)
      return;
    throw InputError(fmt::format(
        "the path turns more tightly {:.4g} m after its start than the swimmer can follow: a head that is led {:.3g} m "
        "before the point about which the body turns cannot point more than a right angle off its way; keep corners at "
        "most right angles, apart by several times that length, and radii above it.",
        need.arc_m, lever_m));
  }
} // namespace swimtwin
