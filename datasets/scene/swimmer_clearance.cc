#include <datasets/scene/swimmer_clearance.h>

#include <datasets/scene/scene_surfaces.h>
#include <datasets/surface/surface_crossings.h>
#include <datasets/surface/surface_distance.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using Point        = std::array<double, 2>;
    using PointInSpace = std::array<double, 3>;

    // Chords of a curve leave it by a 1 / (2 n^2) part of its radius times pi^2: 1e-5 here.
    constexpr int n_chords = 720;
    // Points per straight edge: an inner circle may be closest to the middle of an edge.
    constexpr int n_edge_points = 200;

    void add_edge(std::vector<Point> &outline, const Point &a, const Point &b)
    {
      for (int i = 0; i <= n_edge_points; ++i)
      {
        const double s = static_cast<double>(i) / n_edge_points;
        outline.push_back({(1. - s) * a[0] + s * b[0], (1. - s) * a[1] + s * b[1]});
      }
    }

    void add_head(std::vector<Point> &outline, const Head &head)
    {
      const double a = 0.5 * head.size_m[0], b = 0.5 * head.size_m[1];
      if (head.shape == HeadShape::rectangle)
      {
        const std::array<Point, 4> corners{{{-a, -b}, {a, -b}, {a, b}, {-a, b}}};
        for (std::size_t i = 0; i < corners.size(); ++i)
          add_edge(outline, corners[i], corners[(i + 1) % corners.size()]);
        return;
      }
      for (int i = 0; i < n_chords; ++i)
      {
        const double angle = 2. * std::numbers::pi * i / n_chords;
        outline.push_back({a * std::cos(angle), b * std::sin(angle)});
      }
    }

    /// From the root below to the end, and above back to the root.
    void add_sides(std::vector<Point> &outline, const TailOutline &tail)
    {
      std::vector<Point> above;
      for (int i = 0; i <= n_chords; ++i)
      {
        const double s = static_cast<double>(i) / n_chords, x = (1. - s) * tail.x_root_m + s * tail.x_end_m;
        above.push_back({x, tail.half_height_m(x)});
      }
      for (const auto &[x, r] : above)
        outline.push_back({x, -r});
      outline.insert(outline.end(), above.rbegin(), above.rend());
    }

    void add_tail(std::vector<Point> &outline, const Head &head, const Tail &tail)
    {
      const TailOutline sides = tail_outline(head, tail);
      const double      tip   = 0.5 * tail.tip_height_m;
      if (tail.profile_m.empty())
      {
        const double root = 0.5 * tail.root_height_m;
        add_edge(outline, {sides.x_root_m, -root}, {sides.x_end_m, -tip});
        add_edge(outline, {sides.x_end_m, tip}, {sides.x_root_m, root});
      }
      else
        add_sides(outline, sides);
      if (tail.tip == TipShape::flat)
        return add_edge(outline, {sides.x_end_m, -tip}, {sides.x_end_m, tip});
      for (int i = 0; i <= n_chords / 2; ++i)
      {
        const double angle = std::numbers::pi * (2. * i / n_chords - 0.5);
        outline.push_back({sides.x_end_m + tip * std::cos(angle), tip * std::sin(angle)});
      }
    }

    std::vector<Point> outline_in_head_frame(const Scene &scene)
    {
      std::vector<Point> outline;
      add_head(outline, scene.head);
      if (scene.tail)
        add_tail(outline, scene.head, *scene.tail);
      return outline;
    }

    void place(std::vector<Point> &outline, const Head &head)
    {
      const double c = std::cos(head.angle_rad), s = std::sin(head.angle_rad);
      for (Point &point : outline)
        point = {head.center_m[0] + c * point[0] - s * point[1], head.center_m[1] + s * point[0] + c * point[1]};
    }

    /// Signed distances of a point to the walls, positive inside the fluid.
    std::vector<Clearance> wall_distances(const Domain &domain, const PointInSpace &point)
    {
      const double dx = point[0] - domain.center_m[0], dy = point[1] - domain.center_m[1], z = point[2];
      if (domain.shape == DomainShape::box || domain.shape == DomainShape::channel)
      {
        const double           a = 0.5 * domain.size_m[0], b = 0.5 * domain.size_m[1], c = 0.5 * domain.size_z_m;
        std::vector<Clearance> distances{{"left", a + dx}, {"right", a - dx}, {"bottom", b + dy}, {"top", b - dy}};
        if (c > 0.)
          distances.insert(distances.end(), {{"front", c - z}, {"back", c + z}});
        return distances;
      }
      if (domain.shape == DomainShape::cylinder)
      {
        const double a = 0.5 * domain.size_m[0];
        return {{"left", a + dx}, {"right", a - dx}, {"outer", domain.radius_m - std::hypot(dy, z)}};
      }
      std::vector<Clearance> distances{{"outer", domain.radius_m - std::hypot(dx, dy, z)}};
      if (domain.shape == DomainShape::annulus)
        distances.push_back({"inner", std::hypot(dx, dy) - domain.inner_radius_m});
      return distances;
    }

    /// The outline itself in the plane; in space the circles that its upper half describes about the axis, half of each
    /// where walls are mirrored in z = 0.
    std::vector<PointInSpace> surface_points(const Scene &scene)
    {
      std::vector<PointInSpace> points;
      if (scene.dimension == 2)
      {
        for (const auto &[x, y] : swimmer_outline(scene))
          points.push_back({x, y, 0.});
        return points;
      }
      if (scene.head.surface)
      {
        for (const auto &x : surface_at_start(scene.head).nodes)
          points.push_back({x[0], x[1], x[2]});
        return points;
      }
      constexpr int n_angles = 24; // of half a turn: what is farthest along y or z is among them
      const double  c = std::cos(scene.head.angle_rad), s = std::sin(scene.head.angle_rad);
      const auto    add = [&](const double x, const double y, const double z) {
        points.push_back({scene.head.center_m[0] + c * x - s * y, scene.head.center_m[1] + s * x + c * y, z});
        if (scene.domain->surface && z != 0.)
          points.push_back({points.back()[0], points.back()[1], -z});
      };
      Scene      round   = scene;
      const bool is_film = scene.tail && scene.tail->section == TailSection::rectangular;
      if (is_film)
        round.tail.reset();
      for (const auto &[x, r] : outline_in_head_frame(round))
        for (int i = 0; r >= 0. && i <= n_angles; ++i)
          add(x, r * std::cos(std::numbers::pi * i / n_angles), r * std::sin(std::numbers::pi * i / n_angles));
      if (is_film)
        for (const auto &[x, y] : outline_in_head_frame(scene))
          add(x, y, std::abs(x) > .5 * scene.head.size_m[0] ? .5 * scene.tail->width_m : 0.);
      return points;
    }

    /// How far walls and a body that are both read from surfaces go through each other (m); 0 if they do not.
    double overlap(const ClosedSurface &walls, const ClosedSurface &body)
    {
      const auto found = crossings(body.nodes, flat_triangles(body.faces, body.is_curved), walls.nodes,
                                   flat_triangles(walls.faces, walls.is_curved));
      if (found.n_pairs == 0)
        return 0.;
      const SurfaceDistance to_walls(walls), to_body(body);
      double                most = 1e-6 * extent(body.nodes).size().maxCoeff();
      for (const auto &x : body.nodes)
        if (!to_walls.encloses(x))
          most = std::max(most, to_walls.to(x));
      for (const auto &x : walls.nodes)
        if (to_body.encloses(x))
          most = std::max(most, to_body.to(x));
      return most;
    }

    /// Of points of the body: all as to how near they are, some as to which side they are on.
    Clearance clearance_in_surface(const Scene &scene)
    {
      constexpr std::size_t n_sides = 200;
      const ClosedSurface  &walls   = *scene.domain->surface;
      const auto            wall_at = [&](const unsigned int face) { return walls.patches[walls.patch_of_face[face]]; };
      const SurfaceDistance distance(walls);
      const std::vector<PointInSpace> points = surface_points(scene);
      Clearance                       closest{"", std::numeric_limits<double>::infinity()};
      std::size_t                     n_points = 0;
      for (const auto &[x, y, z] : points)
      {
        const Eigen::Vector3d point(x, y, z);
        const auto            near       = distance.nearest(point);
        const bool            is_outside = n_points++ % (1 + points.size() / n_sides) == 0 && !distance.encloses(point);
        if (const double d = is_outside ? -near.distance_m : near.distance_m; d < closest.distance_m)
          closest = {wall_at(near.face), d};
      }
      if (const double through = scene.head.surface ? overlap(walls, surface_at_start(scene.head)) : 0.; through > 0.)
        closest.distance_m = std::min(closest.distance_m, -through);
      return closest;
    }

    /// The centre of an annulus lies in the fluid's hole: a body around it overlaps the hole although its outline may
    /// not.
    bool body_covers(const Scene &scene, const Point &point)
    {
      const Head  &head = scene.head;
      const double dx = point[0] - head.center_m[0], dy = point[1] - head.center_m[1];
      const double c = std::cos(head.angle_rad), s = std::sin(head.angle_rad);
      const double x = c * dx + s * dy, y = std::abs(c * dy - s * dx);
      const double u = 2. * x / head.size_m[0], v = 2. * y / head.size_m[1];
      if (head.shape == HeadShape::rectangle ? std::max(std::abs(u), v) < 1. : std::hypot(u, v) < 1.)
        return true;
      if (!scene.tail)
        return false;
      const TailOutline sides = tail_outline(head, *scene.tail);
      return x > sides.x_root_m && x < sides.x_end_m && y < sides.half_height_m(x);
    }
  } // namespace

  std::vector<std::array<double, 2>> swimmer_outline(const Scene &scene)
  {
    std::vector<Point> outline = outline_in_head_frame(scene);
    place(outline, scene.head);
    return outline;
  }

  Clearance swimmer_clearance(const Scene &scene)
  {
    const Domain &domain = *scene.domain;
    if (domain.surface)
      return clearance_in_surface(scene);
    Clearance closest{"", std::numeric_limits<double>::infinity()};
    for (const PointInSpace &point : surface_points(scene))
      for (const Clearance &candidate : wall_distances(domain, point))
        if (candidate.distance_m < closest.distance_m)
          closest = candidate;
    if (domain.shape == DomainShape::annulus && body_covers(scene, domain.center_m))
      closest = {"inner", std::min(closest.distance_m, -domain.inner_radius_m)};
    return closest;
  }

  std::string gap_in_words(const Clearance &clearance)
  {
    return fmt::format("the gap of {:.2g} m to the {} wall", clearance.distance_m, clearance.wall);
  }
} // namespace swimtwin
