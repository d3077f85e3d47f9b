#include <fom/mesh/wall_loop.h>

#include <fom/geometry/reflection.h>

#include <algorithm>
#include <numbers>

namespace swimtwin
{
  using namespace dealii;
  using std::numbers::pi;

  namespace
  {
    struct WallCurve
    {
      std::string name;
      PlanarCurve curve;
      bool        backwards = false; ///< divided from its end, as the mirror image of another curve
    };

    /// Outer boundary, counter-clockwise from the middle of its left side, so that mirrored domains have mirrored
    /// polygons.
    std::vector<WallCurve> outer_walls(const Domain &domain, const Point<2> &c)
    {
      const auto line = [](const char *name, const Point<2> &a, const Point<2> &b) {
        return WallCurve{name, PlanarCurve::line(a, b), false};
      };
      const auto back = [](const char *name, const Point<2> &a, const Point<2> &b) {
        return WallCurve{name, PlanarCurve::line(a, b), true};
      };
      if (domain.shape == DomainShape::box || domain.shape == DomainShape::channel)
      {
        const double a = domain.size_m[0] / 2, b = domain.size_m[1] / 2;
        const double l = c[0] - a, r = c[0] + a, d = c[1] - b, u = c[1] + b;
        return {line("left", {l, c[1]}, {l, d}),  line("bottom", {l, d}, {r, d}), line("right", {r, d}, {r, c[1]}),
                back("right", {r, u}, {r, c[1]}), back("top", {l, u}, {r, u}),    back("left", {l, c[1]}, {l, u})};
      }
      const std::array<double, 2> radii = {domain.radius_m, domain.radius_m};
      return {{"outer", PlanarCurve::arc(c, radii, -pi, 0.), false},
              {"outer", PlanarCurve::arc(c, radii, pi, 0.), true}};
    }

    std::vector<WallCurve> inner_walls(const Domain &domain, const Point<2> &c)
    {
      if (domain.shape != DomainShape::annulus)
        return {};
      const std::array<double, 2> radii = {domain.inner_radius_m, domain.inner_radius_m};
      return {{"inner", PlanarCurve::arc(c, radii, -pi, 0.), false},
              {"inner", PlanarCurve::arc(c, radii, pi, 0.), true}};
    }

    WallLoop divide_walls(const std::vector<WallCurve> &walls, const SizeField &size, const bool round)
    {
      WallLoop loop;
      for (const auto &[name, curve, backwards] : walls)
      {
        auto nodes = divide(curve, size, round ? 16 : 2);
        if (backwards)
          std::reverse(nodes.begin(), nodes.end());
        loop.nodes.insert(loop.nodes.end(), nodes.begin(), nodes.end() - 1);
        loop.wall_of_edge.insert(loop.wall_of_edge.end(), nodes.size() / 2, name);
      }
      return loop;
    }

    /// Divide the second half of the walls, the upper one, and reflect it into the place of the first.
    WallLoop reflect_upper_walls(const std::vector<WallCurve> &walls, const SizeField &size, const bool round,
                                 const double plane_y)
    {
      if (walls.empty())
        return {};
      const WallLoop upper = divide_walls({walls.begin() + walls.size() / 2, walls.end()}, size, round);
      WallLoop       loop;
      loop.nodes.emplace_back(walls.front().curve.position(0.)[0], plane_y);
      for (unsigned int i = upper.nodes.size() - 1; i > 0; --i)
        loop.nodes.push_back(mirrored(upper.nodes[i], plane_y));
      loop.nodes.emplace_back(upper.nodes.front()[0], plane_y);
      loop.nodes.insert(loop.nodes.end(), upper.nodes.begin() + 1, upper.nodes.end());
      for (auto name = upper.wall_of_edge.rbegin(); name != upper.wall_of_edge.rend(); ++name)
        loop.wall_of_edge.push_back(*name == "top" ? "bottom" : *name);
      loop.wall_of_edge.insert(loop.wall_of_edge.end(), upper.wall_of_edge.begin(), upper.wall_of_edge.end());
      return loop;
    }
  } // namespace

  bool is_round(const Domain &domain)
  {
    return domain.shape == DomainShape::disc || domain.shape == DomainShape::annulus;
  }

  Point<2> domain_center(const Domain &domain, const RigidPose<2> &pose, const RigidPose<2> &pose_at_rest)
  {
    const Point<2> center(domain.center_m[0], domain.center_m[1]);
    return domain.moves_with_swimmer ? pose.to_laboratory(pose_at_rest.to_head_frame(center)) : center;
  }

  WallLoop outer_loop(const Domain &domain, const Point<2> &center, const SizeField &size)
  {
    return divide_walls(outer_walls(domain, center), size, is_round(domain));
  }

  WallLoop inner_loop(const Domain &domain, const Point<2> &center, const SizeField &size)
  {
    return divide_walls(inner_walls(domain, center), size, true);
  }

  WallLoop mirrored_outer_loop(const Domain &domain, const Point<2> &center, const SizeField &size)
  {
    return reflect_upper_walls(outer_walls(domain, center), size, is_round(domain), center[1]);
  }

  WallLoop mirrored_inner_loop(const Domain &domain, const Point<2> &center, const SizeField &size)
  {
    return reflect_upper_walls(inner_walls(domain, center), size, true, center[1]);
  }

  const std::string &stronger_wall(const Domain &domain, const std::string &before, const std::string &here)
  {
    const auto rank = [&](const std::string &name) {
      switch (domain.walls.at(name).condition)
      {
      case WallCondition::traction_free:
        return 0;
      case WallCondition::inflow:
        return 1;
      case WallCondition::moving_wall:
      case WallCondition::shear_flow:
        return 2;
      default:
        return 3;
      }
    };
    if (rank(before) != rank(here))
      return rank(before) > rank(here) ? before : here;
    return before == "bottom" || before == "top" ? before : here;
  }

  void name_wall_nodes(const Domain &domain, const WallLoop &loop, const std::vector<unsigned int> &nodes,
                       std::vector<WallNode> &wall_nodes)
  {
    const unsigned int n = loop.wall_of_edge.size();
    for (unsigned int e = 0; e < n; ++e)
    {
      const std::string &here   = loop.wall_of_edge[e];
      const std::string &corner = stronger_wall(domain, loop.wall_of_edge[(e + n - 1) % n], here);
      wall_nodes.push_back({nodes[2 * e], &domain.walls.at(corner), corner});
      wall_nodes.push_back({nodes[2 * e + 1], &domain.walls.at(here), here});
    }
  }
} // namespace swimtwin
