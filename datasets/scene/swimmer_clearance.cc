#include <datasets/scene/swimmer_clearance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using Point = std::array<double, 2>;

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

    void add_tail(std::vector<Point> &outline, const Head &head, const Tail &tail)
    {
      const TailOutline sides = tail_outline(head, tail);
      const double      root = 0.5 * tail.root_height_m, tip = 0.5 * tail.tip_height_m;
      add_edge(outline, {sides.x_root_m, -root}, {sides.x_end_m, -tip});
      add_edge(outline, {sides.x_end_m, tip}, {sides.x_root_m, root});
      if (tail.tip == TipShape::flat)
        return add_edge(outline, {sides.x_end_m, -tip}, {sides.x_end_m, tip});
      for (int i = 0; i <= n_chords / 2; ++i)
      {
        const double angle = std::numbers::pi * (2. * i / n_chords - 0.5);
        outline.push_back({sides.x_end_m + tip * std::cos(angle), tip * std::sin(angle)});
      }
    }

    void place(std::vector<Point> &outline, const Head &head)
    {
      const double c = std::cos(head.angle_rad), s = std::sin(head.angle_rad);
      for (Point &point : outline)
        point = {head.center_m[0] + c * point[0] - s * point[1], head.center_m[1] + s * point[0] + c * point[1]};
    }

    /// Signed distances of a point to the walls, positive inside the fluid.
    std::vector<Clearance> wall_distances(const Domain &domain, const Point &point)
    {
      const double dx = point[0] - domain.center_m[0], dy = point[1] - domain.center_m[1];
      if (domain.shape == DomainShape::box || domain.shape == DomainShape::channel)
      {
        const double a = 0.5 * domain.size_m[0], b = 0.5 * domain.size_m[1];
        return {{"left", a + dx}, {"right", a - dx}, {"bottom", b + dy}, {"top", b - dy}};
      }
      if (domain.shape == DomainShape::cylinder)
      {
        const double a = 0.5 * domain.size_m[0];
        return {{"left", a + dx}, {"right", a - dx}, {"outer", domain.radius_m - std::abs(dy)}};
      }
      std::vector<Clearance> distances{{"outer", domain.radius_m - std::hypot(dx, dy)}};
      if (domain.shape == DomainShape::annulus)
        distances.push_back({"inner", std::hypot(dx, dy) - domain.inner_radius_m});
      return distances;
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
      const double      along = (x - sides.x_root_m) / (sides.x_end_m - sides.x_root_m);
      const double      half  = 0.5 * ((1. - along) * scene.tail->root_height_m + along * scene.tail->tip_height_m);
      return along > 0. && along < 1. && y < half;
    }
  } // namespace

  TailOutline tail_outline(const Head &head, const Tail &tail)
  {
    const double a      = 0.5 * head.size_m[0];
    const double height = std::min(1., tail.root_height_m / head.size_m[1]);
    TailOutline  sides;
    sides.x_root_m = head.shape == HeadShape::rectangle ? a : a * std::sqrt(1. - height * height);
    sides.x_tip_m  = a + tail.length_m;
    sides.x_end_m  = sides.x_tip_m - (tail.tip == TipShape::rounded ? 0.5 * tail.tip_height_m : 0.);
    return sides;
  }

  std::vector<std::array<double, 2>> swimmer_outline(const Scene &scene)
  {
    std::vector<Point> outline;
    add_head(outline, scene.head);
    if (scene.tail)
      add_tail(outline, scene.head, *scene.tail);
    place(outline, scene.head);
    return outline;
  }

  Clearance swimmer_clearance(const Scene &scene)
  {
    const Domain &domain = *scene.domain;
    Clearance     closest{"", std::numeric_limits<double>::infinity()};
    for (const Point &point : swimmer_outline(scene))
      for (const Clearance &candidate : wall_distances(domain, point))
        if (candidate.distance_m < closest.distance_m)
          closest = candidate;
    if (domain.shape == DomainShape::annulus && body_covers(scene, domain.center_m))
      closest = {"inner", std::min(closest.distance_m, -domain.inner_radius_m)};
    return closest;
  }
} // namespace swimtwin
