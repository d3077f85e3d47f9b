// Where a swimmer shall go: a curve in the plane by its arc length.
#pragma once

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Nearest point of a path.
  struct PathPlace
  {
    double          arc_m = 0.;
    Eigen::Vector2d point_m, tangent;
    bool            at_corner = false; ///< nearest is a corner: the distance grows whatever the direction
  };

  /// Straight pieces between points; corners are where it turns by more than a curve's pieces do.
  class Path
  {
  public:
    /// At least two different points, in order. Throws InputError.
    static Path through(std::vector<Eigen::Vector2d> points_m, bool closed = false);
    /// These start at the origin along +x and turn left. Sizes must be positive.
    static Path line(double length_m);
    static Path circle(double radius_m);
    static Path square(double side_m);
    /// Two circles, left first.
    static Path figure_eight(double radius_m);

    double                              length_m() const { return arc_m_.back(); }
    bool                                is_closed() const { return closed_; }
    const std::vector<Eigen::Vector2d> &points_m() const
    {
      return points_m_;
    } ///< the first again at a closed one's end

    PathPlace at(double arc_m) const;
    /// Nearest among the places between two arc lengths.
    PathPlace nearest(const Eigen::Vector2d &point_m, double from_m, double to_m) const;
    /// Angle of the path's direction at an arc length, continued along the path from its start (rad).
    double heading_rad(double arc_m) const;
    /// The same of the curve that pieces stand for: linear in arc length between a curve's points, as on a circle, with
    /// jumps at corners alone.
    double direction_rad(double arc_m) const;

    /// Turned about the origin, then shifted.
    Path placed(double angle_rad, const Eigen::Vector2d &shift_m) const;
    /// The way of a front that goes before a point on this path, along its direction: P + ahead t, shifted to begin at
    /// the origin. Throws InputError for a path with corners, where the front would jump.
    Path of_front(double ahead_m) const;
    /// The first part of it.
    Path first(double length_m) const;

  private:
    std::size_t piece(double arc_m) const;
    bool        is_corner(std::size_t point) const;
    /// Half of the turn at a point; 0 at a corner and at an open path's ends.
    double half_turn_rad(std::size_t point) const;

    std::vector<Eigen::Vector2d> points_m_;
    std::vector<double>          arc_m_, heading_rad_; ///< of points; of pieces
    bool                         closed_ = false;
  };

  /// Whether something that is led by its front at `lever_m` before its axle (docs/equations.md, "Adjoint and
  /// tracking") can keep its front on the path, and where it cannot. `heading_rad`: of the body at the start.
  struct PathRequirement
  {
    bool   can_be_followed = true;
    double arc_m = 0., largest_offset_rad = 0.; ///< largest angle between path and body, and where it is met
  };
  PathRequirement path_requirement(const Path &path, double lever_m, double heading_rad);
  /// Throws InputError that says where and what to change.
  void require_followable(const Path &path, double lever_m);
} // namespace swimtwin
