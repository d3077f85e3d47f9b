#include <fom/fluid_mesh.h>
#include <fom/triangulate.h>

#include <algorithm>
#include <cmath>
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

    bool is_round(const Domain &domain)
    {
      return domain.shape == DomainShape::disc || domain.shape == DomainShape::annulus;
    }

    /// A closed boundary: a quadratic loop without repetition, and the wall of each edge.
    struct WallLoop
    {
      std::vector<Point<2>>    nodes;
      std::vector<std::string> wall_of_edge;
    };

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

    std::vector<Point<2>> vertices_of(const std::vector<Point<2>> &loop)
    {
      std::vector<Point<2>> vertices;
      for (unsigned int i = 0; i < loop.size(); i += 2)
        vertices.push_back(loop[i]);
      return vertices;
    }

    /// Place the curved edges of a closed boundary whose vertices are numbered from `first`; returns its nodes in
    /// order.
    std::vector<unsigned int> curve_loop(SimplexMesh<2> &mesh, const std::vector<Point<2>> &loop,
                                         const unsigned int first)
    {
      const unsigned int        n = loop.size() / 2;
      std::vector<unsigned int> nodes;
      for (unsigned int e = 0; e < n; ++e)
      {
        nodes.push_back(first + e);
        nodes.push_back(mesh.edge_node(first + e, first + (e + 1) % n));
        mesh.nodes[nodes.back()] = loop[2 * e + 1];
      }
      return nodes;
    }

    void name_wall_nodes(const Domain &domain, const WallLoop &loop, const std::vector<unsigned int> &nodes,
                         std::vector<WallNode> &wall_nodes)
    {
      const unsigned int n       = loop.wall_of_edge.size();
      const auto         imposes = [&](const std::string &name) {
        return domain.walls.at(name).condition != WallCondition::traction_free;
      };
      for (unsigned int e = 0; e < n; ++e)
      {
        const std::string &here = loop.wall_of_edge[e], &before = loop.wall_of_edge[(e + n - 1) % n];
        // At a corner a wall that imposes a velocity wins over an open end, a solid wall over an inflow.
        const bool         keep_before = !imposes(here) || domain.walls.at(here).condition == WallCondition::inflow;
        const std::string &corner      = keep_before && imposes(before) ? before : here;
        wall_nodes.push_back({nodes[2 * e], &domain.walls.at(corner), corner});
        wall_nodes.push_back({nodes[2 * e + 1], &domain.walls.at(here), here});
      }
    }

    Point<2> domain_center(const Domain &domain, const RigidPose<2> &pose, const RigidPose<2> &pose_at_rest)
    {
      const Point<2> center(domain.center_m[0], domain.center_m[1]);
      return domain.moves_with_swimmer ? pose.to_laboratory(pose_at_rest.to_head_frame(center)) : center;
    }
  } // namespace

  FluidMesh<2> make_fluid_mesh(const Domain &domain, const std::vector<Point<2>> &surface,
                               const std::vector<double> &surface_size, const RigidPose<2> &pose,
                               const RigidPose<2> &pose_at_rest, const Numerics &numerics, const MPI_Comm communicator)
  {
    std::vector<std::pair<Point<2>, double>> prescribed;
    for (unsigned int i = 0; i < surface_size.size(); ++i)
      prescribed.emplace_back(surface[2 * i], surface_size[i]);
    const SizeField size  = graded_size(std::move(prescribed), numerics.mesh_growth, numerics.mesh_size_far_m);
    const Point<2>  c     = domain_center(domain, pose, pose_at_rest);
    const WallLoop  outer = divide_walls(outer_walls(domain, c), size, is_round(domain)),
                   inner  = divide_walls(inner_walls(domain, c), size, true);

    PlanarRegion region;
    region.mirror = numerics.mirror_meshes;
    region.size   = size;
    region.outer  = vertices_of(outer.nodes);
    region.holes.push_back(vertices_of(surface));
    if (!inner.nodes.empty())
      region.holes.push_back(vertices_of(inner.nodes));

    FluidMesh<2>       fluid{SimplexMesh<2>(triangulate(region, communicator), communicator), {}, {}};
    const unsigned int n_outer = region.outer.size(), n_surface = region.holes[0].size();
    name_wall_nodes(domain, outer, curve_loop(fluid.mesh, outer.nodes, 0), fluid.wall_nodes);
    fluid.surface_nodes = curve_loop(fluid.mesh, surface, n_outer);
    if (!inner.nodes.empty())
      name_wall_nodes(domain, inner, curve_loop(fluid.mesh, inner.nodes, n_outer + n_surface), fluid.wall_nodes);
    return fluid;
  }

  FluidMeshRecord<2> record(const FluidMesh<2> &fluid_mesh)
  {
    FluidMeshRecord<2> record{
        {fluid_mesh.mesh.triangulation().get_vertices(), {}}, fluid_mesh.mesh.nodes, fluid_mesh.surface_nodes, {}, {}};
    for (const auto &cell : fluid_mesh.mesh.cells)
      record.soup.cells.push_back({cell[0], cell[1], cell[2]});
    for (const auto &wall_node : fluid_mesh.wall_nodes)
    {
      record.wall_nodes.push_back(wall_node.node);
      record.wall_names.push_back(wall_node.wall_name);
    }
    return record;
  }

  FluidMesh<2> make_fluid_mesh(const Domain &domain, const FluidMeshRecord<2> &record, const MPI_Comm communicator)
  {
    FluidMesh<2> fluid{SimplexMesh<2>(record.soup, communicator), record.surface_nodes, {}};
    fluid.mesh.nodes = record.nodes;
    for (unsigned int i = 0; i < record.wall_nodes.size(); ++i)
      fluid.wall_nodes.push_back({record.wall_nodes[i], &domain.walls.at(record.wall_names[i]), record.wall_names[i]});
    return fluid;
  }

  Tensor<1, 2> wall_velocity(const Domain &domain, const std::string &wall_name, const Point<2> &x, const double time_s)
  {
    const Wall  &wall        = domain.walls.at(wall_name);
    const double ramp        = time_s < wall.ramp_s ? .5 * (1. - std::cos(pi * time_s / wall.ramp_s)) : 1.;
    const double speed       = ramp * wall.speed_m_s;
    const bool   is_vertical = wall_name == "left" || wall_name == "right";
    Tensor<1, 2> v;
    if (wall.condition == WallCondition::moving_wall)
    {
      if (is_round(domain))
      {
        const Tensor<1, 2> r = x - Point<2>(domain.center_m[0], domain.center_m[1]);
        v                    = rotational_velocity<2>(AngularVelocity<2>({speed / r.norm()}), r);
      }
      else
        v[is_vertical ? 1 : 0] = speed;
    }
    else if (wall.condition == WallCondition::inflow)
    {
      const int    along = is_vertical ? 1 : 0;
      const double s     = (x[along] - domain.center_m[along]) / (domain.size_m[along] / 2);
      const double shape = wall.profile == InflowProfile::parabolic ? 1.5 * (1. - s * s) : 1.;
      v[1 - along]       = (wall_name == "left" || wall_name == "bottom" ? 1. : -1.) * shape * speed;
    }
    return v;
  }
} // namespace swimtwin
