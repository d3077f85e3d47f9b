#include <fom/body/swimmer.h>

#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mirror_plane.h>
#include <fom/body/finer_mesh.h>
#include <fom/mesh/swimmer_outline.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  MagneticTorque magnetic_torque(const double moment_A_m2, const double angle_rad, const std::array<double, 3> &field_T)
  {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return {moment_A_m2 * (c * field_T[1] - s * field_T[0]), -moment_A_m2 * (s * field_T[1] + c * field_T[0])};
  }

  template <int dim>
  Swimmer<dim>::Swimmer(const Scene &scene, const MPI_Comm communicator)
      : scene_(scene), body_length_(scene.body_length_m()), is_symmetric_(solves_half(scene)),
        inertia_(inertia_terms(scene))
  {
    const SwimmerOutline outline = make_outline(scene.head, scene.tail, scene.numerics);
    surface_at_rest_             = outline.surface();
    tail_node_of_surface_.assign(surface_at_rest_.size(), -1);
    for (unsigned int k = 0; k < surface_at_rest_.size(); k += 2)
      surface_mesh_size_.push_back(
          .5 * (surface_at_rest_[k].distance(surface_at_rest_[(k + 2) % surface_at_rest_.size()]) +
                surface_at_rest_[k].distance(
                    surface_at_rest_[(k + surface_at_rest_.size() - 2) % surface_at_rest_.size()])));
    if (scene.tail)
      make_tail(outline, communicator);
    if (scene.head.is_free())
      weigh_surface();
  }

  template <int dim>
  void Swimmer<dim>::make_tail(const SwimmerOutline &outline, const MPI_Comm communicator)
  {
    try
    {
      tail_ = std::make_unique<TailMesh<dim>>(make_tail_mesh(outline, scene_.numerics, communicator));
    }
    catch (const ComputationError &error)
    {
      refuse_mesh_size(scene_, error, [&](const Scene &finer) {
        make_tail_mesh(make_outline(finer.head, finer.tail, finer.numerics), finer.numerics, communicator);
        return true;
      });
    }
    const unsigned int first = outline.upper_head.size() - 1;
    for (unsigned int i = 0; i < tail_->surface_nodes.size(); ++i)
      tail_node_of_surface_[first + i] = tail_->surface_nodes[i];
    if (scene_.numerics.tail_order == 1)
      straighten_surface();
    // A tail that is rigid, or whose shape is given, is one that is clamped everywhere.
    const LameConstants lame = scene_.tail->is_elastic()
                                   ? lame_constants(scene_.tail->young_modulus_Pa, scene_.tail->poisson_ratio)
                                   : LameConstants{};
    elasticity_              = std::make_unique<ElasticTail<dim>>(tail_->mesh, make_law<dim>(scene_.tail->law, lame));
    is_clamped_.assign(tail_->mesh.n_nodes(), !scene_.tail->is_elastic());
    for (const auto node : tail_->clamped_nodes)
      is_clamped_[node] = 1;
  }

  template <int dim>
  void Swimmer<dim>::straighten_surface()
  {
    for (unsigned int k = 0; k < surface_at_rest_.size(); ++k)
      if (tail_node_of_surface_[k] >= 0)
        surface_at_rest_[k] = tail_->mesh.nodes[tail_node_of_surface_[k]];
  }

  template <int dim>
  void Swimmer<dim>::weigh_surface()
  {
    // Simpson's rule on every edge: its ends are the even nodes.
    const unsigned int n      = n_surface_nodes();
    double             length = 0.;
    surface_weight_.assign(n, 0.);
    for (unsigned int p = 0; p < n; p += 2)
    {
      const unsigned int q    = (p + 2) % n;
      const double       edge = surface_at_rest_[p].distance(surface_at_rest_[q]);
      surface_weight_[p] += edge / 6.;
      surface_weight_[p + 1] += edge * 4. / 6.;
      surface_weight_[q] += edge / 6.;
      length += edge;
    }
    for (unsigned int k = 0; k < n; ++k)
    {
      surface_weight_[k] /= length;
      arm_at_rest_ += surface_weight_[k] * surface_at_rest_[k];
    }
    if (is_symmetric_)
      arm_at_rest_[1] = 0.;
  }

  template <int dim>
  RigidPose<dim> Swimmer<dim>::pose_at_rest() const
  {
    RigidPose<dim> pose;
    pose.center = Point<dim>(scene_.head.center_m[0], scene_.head.center_m[1]);
    pose.angle  = scene_.head.angle_rad;
    return pose;
  }

  template <int dim>
  Configuration<dim> Swimmer<dim>::configuration_at_rest() const
  {
    return {pose_at_rest(), NodalField<dim>(has_tail() ? tail_->mesh.n_nodes() : 0)};
  }

  template <int dim>
  std::vector<Point<dim>> Swimmer<dim>::surface(const Configuration<dim> &configuration) const
  {
    const Tensor<2, dim>    R = configuration.pose.rotation();
    std::vector<Point<dim>> x;
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
    {
      const int            node = tail_node_of_surface_[k];
      const Tensor<1, dim> X    = surface_at_rest_[k];
      x.push_back(configuration.pose.center + R * (node < 0 ? X : X + configuration.shape[node]));
    }
    return x;
  }

  namespace
  {
    /// Symmetric bilinear form whose value at (x, x) is the area inside a closed curve of quadratic edges; vertices and
    /// mid-edge nodes alternate. Exact: on an edge from p over m to q the integral of x cross dx is
    /// 4/3 (p cross m + m cross q) - 1/3 p cross q.
    double area_form(const std::vector<Tensor<1, 2>> &x, const std::vector<Tensor<1, 2>> &y)
    {
      const auto cross = [](const Tensor<1, 2> &a, const Tensor<1, 2> &b) { return a[0] * b[1] - a[1] * b[0]; };
      double     sum   = 0.;
      for (unsigned int p = 0, n = x.size(); p < n; p += 2)
      {
        const unsigned int m = p + 1, q = (p + 2) % n;
        const auto         term = [&](const unsigned int a, const unsigned int b) {
          return .5 * (cross(x[a], y[b]) + cross(y[a], x[b]));
        };
        sum += (4. * term(p, m) + 4. * term(m, q) - term(p, q)) / 3.;
      }
      return .5 * sum;
    }
  } // namespace

  template <int dim>
  double Swimmer<dim>::area(const Configuration<dim> &configuration) const
  {
    std::vector<Tensor<1, dim>> x; // in the head's frame: a rigid motion changes nothing
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
      x.push_back(surface_at_rest_[k] +
                  (tail_node_of_surface_[k] < 0 ? Tensor<1, dim>() : configuration.shape[tail_node_of_surface_[k]]));
    return area_form(x, x);
  }

  template <int dim>
  double Swimmer<dim>::area_rate(const Configuration<dim> &configuration, const Rates<dim> &rates) const
  {
    std::vector<Tensor<1, dim>> x, v;
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
    {
      const int node = tail_node_of_surface_[k];
      x.push_back(surface_at_rest_[k] + (node < 0 ? Tensor<1, dim>() : configuration.shape[node]));
      v.push_back(node < 0 ? Tensor<1, dim>() : rates.shape_rate[node]);
    }
    return 2. * area_form(x, v);
  }

  template <int dim>
  Tensor<1, dim> Swimmer<dim>::arm_to_middle(const NodalField<dim> &shape) const
  {
    return arm_at_rest_ + rate_of_arm(shape);
  }

  template <int dim>
  Tensor<1, dim> Swimmer<dim>::rate_of_arm(const NodalField<dim> &shape_rate) const
  {
    Tensor<1, dim> rate;
    for (unsigned int k = 0; k < surface_weight_.size(); ++k)
      if (tail_node_of_surface_[k] >= 0)
        rate += surface_weight_[k] * shape_rate[tail_node_of_surface_[k]];
    if (is_symmetric_)
      rate[1] = 0.; // but for the sum's rounding
    return rate;
  }

  template <int dim>
  std::vector<Point<dim>> Swimmer<dim>::tail_positions(const Configuration<dim> &configuration) const
  {
    const Tensor<2, dim>    R = configuration.pose.rotation();
    std::vector<Point<dim>> x;
    for (unsigned int a = 0; a < tail_->mesh.n_nodes(); ++a)
      x.push_back(configuration.pose.center + R * (tail_->mesh.nodes[a] + configuration.shape[a]));
    return x;
  }

  template <int dim>
  NodalField<dim> Swimmer<dim>::tail_velocities(const Configuration<dim> &configuration, const Rates<dim> &rates) const
  {
    const Tensor<2, dim> R = configuration.pose.rotation();
    const auto           x = tail_positions(configuration);
    NodalField<dim>      w;
    for (unsigned int a = 0; a < x.size(); ++a)
      w.push_back(rates.velocity + rotational_velocity<dim>(rates.omega, x[a] - configuration.pose.center) +
                  R * rates.shape_rate[a]);
    return w;
  }

  template <int dim>
  BodyVelocities<dim> Swimmer<dim>::velocities(const Configuration<dim> &configuration, const Rates<dim> &rates) const
  {
    return {rates.velocity, rates.omega, has_tail() ? tail_velocities(configuration, rates) : NodalField<dim>()};
  }

  template <int dim>
  double Swimmer<dim>::kinetic_energy(const BodyVelocities<dim> &v) const
  {
    double energy = 0.;
    if (inertia_.head)
      energy += .5 * head_mass() * v.head.norm_square() + .5 * head_moment_of_inertia() * v.omega.norm_square();
    if (inertia_.tail)
      energy += .5 * scene_.tail->density_kg_m3 * elasticity_->norm_square(v.tail);
    return energy;
  }

  template <int dim>
  NodalField<dim> Swimmer<dim>::inertial_force_on_tail(const NodalField<dim> &acceleration) const
  {
    if (!inertia_.tail || acceleration.empty())
      return {};
    const auto     &mesh = tail_->mesh;
    NodalField<dim> force(mesh.n_nodes());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
          force[mesh.cells[c][a]] +=
              scene_.tail->density_kg_m3 * elasticity_->cell_mass(c, a, b) * acceleration[mesh.cells[c][b]];
    return force;
  }

  template <int dim>
  double Swimmer<dim>::relative_change(const Configuration<dim> &a, const Configuration<dim> &b) const
  {
    double change = std::max(a.pose.center.distance(b.pose.center) / body_length_,
                             (a.pose.rotation() - b.pose.rotation()).norm() / std::sqrt(double(dim)));
    if (has_tail())
    {
      const auto      xa = tail_positions(a), xb = tail_positions(b);
      NodalField<dim> difference(xa.size());
      for (unsigned int i = 0; i < xa.size(); ++i)
        difference[i] = xa[i] - xb[i];
      change = std::max(change, std::sqrt(elasticity_->norm_square(difference) / elasticity_->volume()) / body_length_);
    }
    return change;
  }

  template <int dim>
  Tensor<1, dim> Swimmer<dim>::effective_gravity(const double body_density_kg_m3, const double time_s) const
  {
    // In a fluid the pressure is the reduced one, without the hydrostatic part: buoyancy is taken off here.
    const Gravity &gravity = scene_.gravity;
    const double   ramp    = time_s < gravity.ramp_s ? time_s / gravity.ramp_s : 1.;
    const double   density = body_density_kg_m3 - (scene_.fluid ? scene_.fluid->density_kg_m3 : 0.);
    Tensor<1, dim> g;
    for (int c = 0; c < 2; ++c)
      g[c] = ramp * density * gravity.acceleration_m_s2[c];
    return g;
  }

  template <int dim>
  Tensor<1, dim> Swimmer<dim>::load_on_tail_node(const unsigned int a, const double time_s) const
  {
    return elasticity_->volume_of_node()[a] * effective_gravity(scene_.tail->density_kg_m3, time_s) +
           magnetic_load_on_tail_node(a, time_s);
  }

  template <int dim>
  Tensor<1, dim> Swimmer<dim>::magnetic_load_on_tail_node(const unsigned int a, const double time_s) const
  {
    Tensor<1, dim> load;
    if (scene_.tail->magnetization_A_m != 0.)
    {
      const auto field = scene_.field(time_s);
      for (int c = 0; c < dim; ++c)
        load[c] = scene_.tail->magnetization_A_m * elasticity_->axial_gradient_of_node()[a] * field[c];
    }
    return load;
  }

  template <int dim>
  Tensor<1, dim> Swimmer<dim>::force_on_head(const double time_s) const
  {
    // What holds a head carries its weight too, but that is not asked of a scene and not reported.
    if (!scene_.head.is_free())
      return {};
    return scene_.head.area_m2() * effective_gravity(scene_.head.density_kg_m3, time_s);
  }

  template <int dim>
  MagneticTorque Swimmer<dim>::torque_on_head(const double angle_rad, const double time_s) const
  {
    return magnetic_torque(scene_.head.magnetization_A_m * scene_.head.area_m2(), angle_rad, scene_.field(time_s));
  }

  template <int dim>
  double Swimmer<dim>::tail_angle(const Configuration<dim> &configuration) const
  {
    if (!has_tail())
      return configuration.pose.angle;
    const auto &[before, middle, tip] = tail_->axis_at_tip;
    const auto position = [&](const unsigned int node) { return tail_->mesh.nodes[node] + configuration.shape[node]; };
    // Derivative at its end of the quadratic through the last edge of the axis, relative to the head.
    const Tensor<1, dim> tangent =
        3. * position(tip) - 4. * Tensor<1, dim>(position(middle)) + Tensor<1, dim>(position(before));
    return configuration.pose.angle + std::atan2(tangent[1], tangent[0]);
  }

  template class Swimmer<2>;
} // namespace swimtwin
