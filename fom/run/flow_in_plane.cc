#include <fom/run/flow_in_plane.h>

#include <datasets/surface/closed_surface.h>
#include <fom/geometry/cell_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr int    n_instants = 4;
    constexpr double spacing = 1. / 64, margin = 0.35; ///< body lengths

    template <int dim>
    Point<dim> point_in_plane(const double x, const double y)
    {
      Point<dim> point;
      point[0] = x;
      point[1] = y;
      return point;
    }

    struct Chord
    {
      Point<2> a, b;
      bool     is_tail;
    };

    void cut_face(const FaceNodes<2> &face, const std::vector<Point<2>> &x, const bool is_tail,
                  std::vector<Chord> &chords)
    {
      chords.push_back({x[face[0]], x[face[1]], is_tail});
      chords.push_back({x[face[1]], x[face[2]], is_tail});
    }

    /// A quadratic face as four plane triangles. An edge in the plane belongs to the triangle above it alone.
    void cut_face(const FaceNodes<3> &face, const std::vector<Point<3>> &x, const bool is_tail,
                  std::vector<Chord> &chords)
    {
      for (const auto &corners : flat_triangles({face}, true))
      {
        std::vector<Point<2>> ends;
        for (int i = 0; i < 3; ++i)
        {
          const Point<3> &a = x[corners[i]], &b = x[corners[(i + 1) % 3]];
          if ((a[2] > 0.) == (b[2] > 0.))
            continue;
          const double s = a[2] / (a[2] - b[2]);
          ends.emplace_back(a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]));
        }
        if (ends.size() == 2)
          chords.push_back({ends[0], ends[1], is_tail});
      }
    }

    /// Section of the body's surface.
    template <int dim>
    std::vector<Chord> section(const Swimmer<dim> &swimmer, const std::vector<Point<dim>> &surface)
    {
      std::vector<Chord> chords;
      for (const auto &face : swimmer.body().surface.faces)
        cut_face(face, surface,
                 std::all_of(face.begin(), face.end(), [&](const unsigned int k) { return swimmer.tail_node(k) >= 0; }),
                 chords);
      return chords;
    }

    /// Whether a ray from the point crosses them an odd number of times.
    bool is_inside(const std::vector<Chord> &chords, const double x, const double y)
    {
      bool inside = false;
      for (const auto &[a, b, is_tail] : chords)
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
          inside = !inside;
      return inside;
    }

    Eigen::MatrixXd ends_of(const std::vector<Chord> &chords, const bool of_tail)
    {
      std::vector<Chord> chosen;
      std::copy_if(chords.begin(), chords.end(), std::back_inserter(chosen),
                   [&](const Chord &chord) { return chord.is_tail == of_tail; });
      Eigen::MatrixXd ends(chosen.size(), 4);
      for (std::size_t k = 0; k < chosen.size(); ++k)
        ends.row(k) << chosen[k].a[0], chosen[k].a[1], chosen[k].b[0], chosen[k].b[1];
      return ends;
    }

    /// The body's extent along an axis and a margin on either side.
    template <int dim>
    std::vector<double> grid_around(const std::vector<Point<dim>> &surface, const int axis, const double length_m)
    {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const auto &point : surface)
      {
        low  = std::min(low, point[axis]);
        high = std::max(high, point[axis]);
      }
      const int           n      = 1 + static_cast<int>(std::ceil(((high - low) / length_m + 2. * margin) / spacing));
      const double        middle = .5 * (low + high), step = spacing * length_m;
      std::vector<double> x;
      for (int i = 0; i < n; ++i)
        x.push_back(middle + (i - .5 * (n - 1)) * step);
      return x;
    }

    template <int dim>
    NodalField<dim> nodal_velocity(const FluidDomain<dim> &fluid, const std::vector<double> &values)
    {
      NodalField<dim> u(fluid.mesh().n_nodes());
      for (unsigned int node = 0; node < u.size(); ++node)
        for (int c = 0; c < dim; ++c)
          u[node][c] = values[fluid.numbering().vector_index(node, c)];
      return u;
    }

    /// A mesh with a velocity at its nodes.
    template <int dim>
    class SampledMesh
    {
    public:
      SampledMesh(const SimplexMesh<dim> &mesh, std::vector<Point<dim>> positions, NodalField<dim> velocity)
          : mesh_(mesh), positions_(std::move(positions)), velocity_(std::move(velocity)), search_(mesh_, positions_)
      {
      }

      /// None outside.
      std::optional<Tensor<1, dim>> velocity_at(const Point<dim> &x) const
      {
        constexpr double round_off = 1e-6;
        const auto       found     = search_.find(x);
        if (!found || found->outside > round_off)
          return std::nullopt;
        return found->interpolate(mesh_.cells[found->cell], velocity_);
      }

    private:
      const SimplexMesh<dim> &mesh_;
      std::vector<Point<dim>> positions_;
      NodalField<dim>         velocity_;
      CellSearch<dim>         search_;
    };
  } // namespace

  bool is_flow_instant(const int n_steps, const int steps_per_period, const int step)
  {
    const int n_periods = n_steps / steps_per_period;
    const int length = n_periods > 0 ? steps_per_period : n_steps, end = n_periods > 0 ? n_periods * length : n_steps;
    for (int k = 1; k <= n_instants; ++k)
      if (const int after = k * length / n_instants; after > 0 && step == end - length + after)
        return true;
    return false;
  }

  template <int dim>
  PlaneFlow flow_in_plane(const FieldInstant<dim> &instant)
  {
    const auto &[time_s, swimmer, configuration, rates, fluid, fluid_values] = instant;
    const auto             surface                                           = swimmer.surface(configuration);
    const auto             chords                                            = section<dim>(swimmer, surface);
    const SampledMesh<dim> flow(fluid->mesh(), fluid->positions(), nodal_velocity(*fluid, fluid_values));

    std::optional<SampledMesh<dim>> tail;
    if (swimmer.has_tail())
      tail.emplace(swimmer.tail().mesh, swimmer.tail_positions(configuration),
                   swimmer.tail_velocities(configuration, rates));

    const double length_m = swimmer.scene().body_length_m();
    PlaneFlow    result{time_s,
                     grid_around(surface, 0, length_m),
                     grid_around(surface, 1, length_m),
                     {},
                     {},
                     ends_of(chords, false),
                     ends_of(chords, true)};
    const auto   n = static_cast<Eigen::Index>(result.x_m.size() * result.y_m.size());
    result.velocity_m_s.setZero(n, dim);
    result.part.setConstant(n, static_cast<int>(SampledPart::nothing));
    Eigen::Index row  = 0;
    const auto   note = [&](const SampledPart part, const Tensor<1, dim> &velocity) {
      result.part[row] = static_cast<int>(part);
      for (int c = 0; c < dim; ++c)
        result.velocity_m_s(row, c) = velocity[c];
    };
    for (const double y : result.y_m)
      for (const double x : result.x_m)
      {
        const auto point = point_in_plane<dim>(x, y);
        if (const auto of_fluid = flow.velocity_at(point))
          note(SampledPart::fluid, *of_fluid);
        else if (const auto of_tail = tail ? tail->velocity_at(point) : std::nullopt)
          note(SampledPart::tail, *of_tail);
        else if (is_inside(chords, x, y))
          note(SampledPart::head,
               rates.velocity + rotational_velocity<dim>(rates.omega, point - configuration.pose.center));
        ++row;
      }
    return result;
  }

  template PlaneFlow flow_in_plane<2>(const FieldInstant<2> &);
  template PlaneFlow flow_in_plane<3>(const FieldInstant<3> &);
} // namespace swimtwin
