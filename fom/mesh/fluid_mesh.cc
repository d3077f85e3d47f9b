#include <fom/mesh/fluid_mesh.h>

#include <fom/geometry/reflection.h>
#include <fom/mesh/inverted_element.h>
#include <fom/mesh/wall_loop.h>
#include <fom/meshing/triangulate.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace swimtwin
{
  using namespace dealii;
  using std::numbers::pi;

  namespace
  {
    std::vector<Point<2>> vertices_of(const std::vector<Point<2>> &loop)
    {
      std::vector<Point<2>> vertices;
      for (unsigned int i = 0; i < loop.size(); i += 2)
        vertices.push_back(loop[i]);
      return vertices;
    }

    /// Place the curved edges of a closed boundary whose vertices have these numbers; returns its nodes in order.
    std::vector<unsigned int> curve_loop(SimplexMesh<2> &mesh, const std::vector<Point<2>> &loop,
                                         const std::vector<unsigned int> &vertices)
    {
      const unsigned int        n = vertices.size();
      std::vector<unsigned int> nodes;
      for (unsigned int e = 0; e < n; ++e)
      {
        nodes.push_back(vertices[e]);
        nodes.push_back(mesh.edge_node(vertices[e], vertices[(e + 1) % n]));
        mesh.nodes[nodes.back()] = loop[2 * e + 1];
      }
      return nodes;
    }

    /// Numbers of a loop's vertices, counted from `first`.
    std::vector<unsigned int> numbers_from(const unsigned int first, const std::vector<Point<2>> &loop)
    {
      std::vector<unsigned int> numbers(loop.size() / 2);
      std::iota(numbers.begin(), numbers.end(), first);
      return numbers;
    }

    SizeField size_field(const std::vector<Point<2>> &surface, const std::vector<double> &surface_size,
                         const Numerics &numerics)
    {
      std::vector<std::pair<Point<2>, double>> prescribed;
      for (unsigned int i = 0; i < surface_size.size(); ++i)
        prescribed.emplace_back(surface[2 * i], surface_size[i]);
      return graded_size(std::move(prescribed), numerics.mesh_growth, numerics.mesh_size_far_m);
    }

    /// Upper half of a region as one polygon, walked counter-clockwise from the left end of the plane. Loops start with
    /// their left end on the plane and go round below; half way they are at their right end.
    class UpperHalf
    {
    public:
      UpperHalf(const SizeField &size, const Point<2> &left_end) : polygon_{left_end}, size_(size) {}

      /// Follow the plane to a hole and pass over it. Returns the numbers of the loop's upper vertices, in their
      /// places.
      std::vector<unsigned int> pass_over(const std::vector<Point<2>> &hole)
      {
        std::vector<unsigned int> numbers(hole.size() / 2);
        walk_along_plane(hole.front());
        for (unsigned int e = numbers.size(); e >= numbers.size() / 2; --e)
          append(hole, e % numbers.size(), numbers);
        return numbers;
      }
      /// Follow the plane to the right end of the outer boundary, and this back over the top.
      std::vector<unsigned int> go_back(const std::vector<Point<2>> &outer)
      {
        std::vector<unsigned int> numbers(outer.size() / 2, 0);
        walk_along_plane(outer[outer.size() / 2]);
        for (unsigned int e = numbers.size() / 2; e < numbers.size(); ++e)
          append(outer, e, numbers);
        return numbers;
      }
      PlanarRegion region() const { return {polygon_, {}, size_}; }

    private:
      void walk_along_plane(const Point<2> &end)
      {
        const auto nodes = divide(PlanarCurve::line(polygon_.back(), end), size_);
        for (unsigned int i = 2; i + 2 < nodes.size(); i += 2)
          polygon_.push_back(nodes[i]);
      }
      void append(const std::vector<Point<2>> &loop, const unsigned int vertex, std::vector<unsigned int> &numbers)
      {
        numbers[vertex] = polygon_.size();
        polygon_.push_back(loop[2 * vertex]);
      }

      std::vector<Point<2>> polygon_;
      SizeField             size_;
    };

    /// Fill in the lower vertices of a loop.
    std::vector<unsigned int> both_halves(std::vector<unsigned int> numbers, const std::vector<unsigned int> &image)
    {
      for (unsigned int e = 1; e < numbers.size() / 2; ++e)
        numbers[e] = image[numbers[numbers.size() - e]];
      return numbers;
    }
  } // namespace

  FluidMesh<2> make_fluid_mesh(const Domain &domain, const std::vector<Point<2>> &surface,
                               const std::vector<double> &surface_size, const RigidPose<2> &pose,
                               const RigidPose<2> &pose_at_rest, const Numerics &numerics, const MPI_Comm communicator)
  {
    const SizeField size  = size_field(surface, surface_size, numerics);
    const Point<2>  c     = domain_center(domain, pose, pose_at_rest);
    const WallLoop  outer = outer_loop(domain, c, size), inner = inner_loop(domain, c, size);

    PlanarRegion region;
    region.mirror = numerics.mirror_meshes;
    region.size   = size;
    region.outer  = vertices_of(outer.nodes);
    region.holes.push_back(vertices_of(surface));
    if (!inner.nodes.empty())
      region.holes.push_back(vertices_of(inner.nodes));

    FluidMesh<2>       fluid{SimplexMesh<2>(triangulate(region, communicator), communicator), {}, {}, {}};
    const unsigned int n_outer = region.outer.size(), n_surface = region.holes[0].size();
    name_wall_nodes(domain, outer, curve_loop(fluid.mesh, outer.nodes, numbers_from(0, outer.nodes)), fluid.wall_nodes);
    fluid.surface_nodes = curve_loop(fluid.mesh, surface, numbers_from(n_outer, surface));
    if (!inner.nodes.empty())
      name_wall_nodes(domain, inner,
                      curve_loop(fluid.mesh, inner.nodes, numbers_from(n_outer + n_surface, inner.nodes)),
                      fluid.wall_nodes);
    refuse_inverted_elements(fluid.mesh, name_of_fluid_mesh);
    return fluid;
  }

  FluidMesh<2> make_symmetric_fluid_mesh(const Domain &domain, const std::vector<Point<2>> &surface,
                                         const std::vector<double> &surface_size, const RigidPose<2> &pose,
                                         const RigidPose<2> &pose_at_rest, const Numerics &numerics,
                                         const MPI_Comm communicator)
  {
    const SizeField size  = size_field(surface, surface_size, numerics);
    const Point<2>  c     = domain_center(domain, pose, pose_at_rest);
    const WallLoop  outer = mirrored_outer_loop(domain, c, size), inner = mirrored_inner_loop(domain, c, size);

    UpperHalf                 half(size, outer.nodes.front());
    const bool                inner_comes_first = !inner.nodes.empty() && inner.nodes.front()[0] < surface.front()[0];
    std::vector<unsigned int> inner_numbers, surface_numbers;
    if (inner_comes_first)
      inner_numbers = half.pass_over(inner.nodes);
    surface_numbers = half.pass_over(surface);
    if (!inner.nodes.empty() && !inner_comes_first)
      inner_numbers = half.pass_over(inner.nodes);
    const auto outer_numbers = half.go_back(outer.nodes);

    std::vector<unsigned int> image;
    const SimplexSoup<2>      soup = reflect(triangulate(half.region(), communicator), c[1], image);
    FluidMesh<2>              fluid{SimplexMesh<2>(soup, communicator), {}, {}, image};
    const auto                nodes = [&](const std::vector<Point<2>> &loop, const std::vector<unsigned int> &numbers) {
      return curve_loop(fluid.mesh, loop, both_halves(numbers, image));
    };
    name_wall_nodes(domain, outer, nodes(outer.nodes, outer_numbers), fluid.wall_nodes);
    fluid.surface_nodes = nodes(surface, surface_numbers);
    if (!inner.nodes.empty())
      name_wall_nodes(domain, inner, nodes(inner.nodes, inner_numbers), fluid.wall_nodes);
    refuse_inverted_elements(fluid.mesh, name_of_fluid_mesh);
    return fluid;
  }

  template <int dim>
  FluidMeshRecord<dim> record(const FluidMesh<dim> &fluid_mesh)
  {
    FluidMeshRecord<dim> record{{fluid_mesh.mesh.triangulation().get_vertices(), {}},
                                fluid_mesh.mesh.nodes,
                                fluid_mesh.surface_nodes,
                                {},
                                {},
                                fluid_mesh.image_of_vertex};
    for (const auto &cell : fluid_mesh.mesh.cells)
      std::copy_n(cell.begin(), dim + 1, record.soup.cells.emplace_back().begin());
    for (const auto &wall_node : fluid_mesh.wall_nodes)
    {
      record.wall_nodes.push_back(wall_node.node);
      record.wall_names.push_back(wall_node.wall_name);
    }
    return record;
  }

  template <int dim>
  FluidMesh<dim> make_fluid_mesh(const Domain &domain, const FluidMeshRecord<dim> &record, const MPI_Comm communicator)
  {
    FluidMesh<dim> fluid{SimplexMesh<dim>(record.soup, communicator), record.surface_nodes, {}, record.image_of_vertex};
    fluid.mesh.nodes = record.nodes;
    refuse_inverted_elements(fluid.mesh, name_of_fluid_mesh);
    for (unsigned int i = 0; i < record.wall_nodes.size(); ++i)
      fluid.wall_nodes.push_back({record.wall_nodes[i], &domain.walls.at(record.wall_names[i]), record.wall_names[i]});
    return fluid;
  }

  template <int dim>
  Tensor<1, dim> wall_velocity(const Domain &domain, const std::string &wall_name, const Point<dim> &x,
                               const double time_s)
  {
    const Wall    &wall        = domain.walls.at(wall_name);
    const double   ramp        = time_s < wall.ramp_s ? .5 * (1. - std::cos(pi * time_s / wall.ramp_s)) : 1.;
    const double   speed       = ramp * wall.speed_m_s;
    const bool     is_vertical = wall_name == "left" || wall_name == "right";
    Tensor<1, dim> v;
    if (wall.condition == WallCondition::moving_wall)
    {
      if (is_round(domain) || domain.shape == DomainShape::sphere)
      {
        // about the axis along z, a sphere as a whole
        const double a = x[0] - domain.center_m[0], b = x[1] - domain.center_m[1],
                     rate = speed / (dim == 3 ? domain.radius_m : std::hypot(a, b));
        v[0]              = -rate * b;
        v[1]              = rate * a;
      }
      else
        v[is_vertical ? 1 : 0] = speed;
    }
    else if (wall.condition == WallCondition::shear_flow)
      v[0] = ramp * wall.shear_rate_1_s * (x[1] - domain.center_m[1]);
    else if (wall.condition == WallCondition::inflow)
    {
      const int    along = is_vertical ? 1 : 0;
      const double s     = (x[along] - domain.center_m[along]) / (domain.size_m[along] / 2);
      double       shape = wall.profile == InflowProfile::parabolic ? 1.5 * (1. - s * s) : 1.;
      if (dim == 3 && wall.profile == InflowProfile::parabolic)
      {
        const double z = x[dim - 1] / (domain.size_z_m / 2);
        shape *= 1.5 * (1. - z * z);
      }
      v[1 - along] = (wall_name == "left" || wall_name == "bottom" ? 1. : -1.) * shape * speed;
    }
    return v;
  }

  template FluidMeshRecord<2> record<2>(const FluidMesh<2> &);
  template FluidMeshRecord<3> record<3>(const FluidMesh<3> &);
  template FluidMesh<2>       make_fluid_mesh<2>(const Domain &, const FluidMeshRecord<2> &, MPI_Comm);
  template FluidMesh<3>       make_fluid_mesh<3>(const Domain &, const FluidMeshRecord<3> &, MPI_Comm);
  template Tensor<1, 2>       wall_velocity<2>(const Domain &, const std::string &, const Point<2> &, double);
  template Tensor<1, 3>       wall_velocity<3>(const Domain &, const std::string &, const Point<3> &, double);

} // namespace swimtwin
