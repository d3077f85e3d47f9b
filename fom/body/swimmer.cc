#include <fom/body/swimmer.h>

#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mesh_rules.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/surface/closed_surface.h>
#include <fom/body/finer_mesh.h>
#include <fom/mesh/inverted_element.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Some unit vector across a unit vector; across one in the plane of x and y, that of z.
    Tensor<1, 3> across(const Tensor<1, 3> &direction)
    {
      Tensor<1, 3> other;
      other[std::abs(direction[2]) < .9 ? 2 : 0] = 1.;
      other -= (other * direction) * direction;
      return other / other.norm();
    }

    /// A vector turned as another one has to be turned, by the shortest way, to lie along +x.
    Tensor<1, 3> turned_with(const Tensor<1, 3> &vector, const Tensor<1, 3> &other)
    {
      const Tensor<1, 3> from = other / other.norm(), axis = cross_product_3d(from, Tensor<1, 3>({1., 0., 0.}));
      return from[0] * vector + cross_product_3d(axis, vector) + axis * (axis * vector) / (1. + from[0]);
    }
  } // namespace

  template <int dim>
  MagneticTorque<dim> magnetic_torque(const double moment_A_m2, const Tensor<1, dim> &direction,
                                      const Attitude<dim> &attitude, const std::array<double, 3> &field_T)
  {
    const Tensor<2, dim> R = attitude.rotation();
    const Tensor<1, dim> m = moment_A_m2 * (R * direction);
    Tensor<1, dim>       B;
    for (int c = 0; c < dim; ++c)
      B[c] = field_T[c];
    MagneticTorque<dim> result;
    result.torque = torque_of_force<dim>(m, B);
    if constexpr (dim == 2)
    {
      result.derivative[0][0] = -m * B;
      result.axis[0]          = 1.;
    }
    else
    {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          result.derivative[i][j] = .5 * (m[i] * B[j] + m[j] * B[i]) - (i == j ? m * B : 0.);
      const double size = result.torque.norm();
      result.axis       = size > 0. ? result.torque / size : R * across(direction);
    }
    return result;
  }

  template <int dim>
  Swimmer<dim>::Swimmer(const Scene &scene, const MPI_Comm communicator)
      : Swimmer(scene, make_body(scene, communicator))
  {
  }

  template <int dim>
  Swimmer<dim>::Swimmer(const Scene &scene, BodyMesh<dim> body)
      : scene_(scene), body_(std::move(body)), body_length_(scene.body_length_m()), is_symmetric_(solves_half(scene)),
        inertia_(inertia_terms(scene))
  {
    if (has_tail())
      make_tail();
    if (scene.head.is_free())
      weigh_surface();
  }

  template <int dim>
  BodyMesh<dim> Swimmer<dim>::make_body(const Scene &scene, const MPI_Comm communicator)
  {
    try
    {
      return make_body_mesh<dim>(scene, communicator);
    }
    catch (const OutOfMemory &)
    {
      throw;
    }
    catch (const ComputationError &error)
    {
      if (scene.head.surface)
        throw InputError(fmt::format("{}: the tail cannot be meshed with the triangles of {} ({}); mesh the surface "
                                     "anew, finer where it is thin or curved, and without slivers",
                                     scene.name, scene.head.surface->file.string(), error.what()));
      const bool is_folded = dynamic_cast<const InvertedElement *>(&error) != nullptr;
      refuse_mesh_size(scene, error,
                       {[&](const Scene &finer) {
                          make_body_mesh<dim>(finer, communicator);
                          return true;
                        },
                        [](const Scene &finer) { return 4. * expected_body_cells(finer); }, // a folded one is made anew
                        is_folded ? "blunt the tail's tip, or let its thickness change more gently there" : ""});
    }
  }

  template <int dim>
  void Swimmer<dim>::make_tail()
  {
    // A tail that is rigid, or whose shape is given, is one that is clamped everywhere.
    const LameConstants lame = scene_.tail->is_elastic()
                                   ? lame_constants(scene_.tail->young_modulus_Pa, scene_.tail->poisson_ratio)
                                   : LameConstants{};
    elasticity_              = std::make_unique<ElasticTail<dim>>(tail().mesh, make_law<dim>(scene_.tail->law, lame));
    is_clamped_.assign(tail().mesh.n_nodes(), !scene_.tail->is_elastic());
    for (const auto node : tail().clamped_nodes)
      is_clamped_[node] = 1;
  }

  template <int dim>
  void Swimmer<dim>::weigh_surface()
  {
    surface_weight_ = surface_shares<dim>(body_.surface);
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
      arm_at_rest_ += surface_weight_[k] * body_.surface.nodes[k];
    if (is_symmetric_)
      arm_at_rest_[dim - 1] = 0.;
  }

  template <int dim>
  RigidPose<dim> Swimmer<dim>::pose_at_rest() const
  {
    RigidPose<dim> pose;
    for (int c = 0; c < 2; ++c)
      pose.center[c] = scene_.head.center_m[c];
    pose.set_attitude(Attitude<dim>::about_z(scene_.head.angle_rad));
    return pose;
  }

  template <int dim>
  Configuration<dim> Swimmer<dim>::configuration_at_rest() const
  {
    return {pose_at_rest(), NodalField<dim>(has_tail() ? tail().mesh.n_nodes() : 0)};
  }

  template <int dim>
  std::vector<Point<dim>> Swimmer<dim>::surface(const Configuration<dim> &configuration) const
  {
    const Tensor<2, dim>    R = configuration.pose.rotation();
    std::vector<Point<dim>> x;
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
    {
      const int            node = body_.tail_node[k];
      const Tensor<1, dim> X    = body_.surface.nodes[k];
      x.push_back(configuration.pose.center + R * (node < 0 ? X : X + configuration.shape[node]));
    }
    return x;
  }

  template <int dim>
  std::vector<Tensor<1, dim>> Swimmer<dim>::surface_in_head_frame(const Configuration<dim> &configuration) const
  {
    std::vector<Tensor<1, dim>> x;
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
      x.push_back(body_.surface.nodes[k] +
                  (body_.tail_node[k] < 0 ? Tensor<1, dim>() : configuration.shape[body_.tail_node[k]]));
    return x;
  }

  template <int dim>
  double Swimmer<dim>::volume(const Configuration<dim> &configuration) const
  {
    return enclosed_volume<dim>(body_.surface.faces,
                                surface_in_head_frame(configuration)); // no rigid motion changes it
  }

  template <int dim>
  double Swimmer<dim>::volume_rate(const Configuration<dim> &configuration, const Rates<dim> &rates) const
  {
    std::vector<Tensor<1, dim>> v;
    for (unsigned int k = 0; k < n_surface_nodes(); ++k)
      v.push_back(body_.tail_node[k] < 0 ? Tensor<1, dim>() : rates.shape_rate[body_.tail_node[k]]);
    return enclosed_volume_rate<dim>(body_.surface.faces, surface_in_head_frame(configuration), v);
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
      if (body_.tail_node[k] >= 0)
        rate += surface_weight_[k] * shape_rate[body_.tail_node[k]];
    if (is_symmetric_)
      rate[dim - 1] = 0.; // but for the sum's rounding
    return rate;
  }

  template <int dim>
  std::vector<Point<dim>> Swimmer<dim>::tail_positions(const Configuration<dim> &configuration) const
  {
    const Tensor<2, dim>    R = configuration.pose.rotation();
    std::vector<Point<dim>> x;
    for (unsigned int a = 0; a < tail().mesh.n_nodes(); ++a)
      x.push_back(configuration.pose.center + R * (tail().mesh.nodes[a] + configuration.shape[a]));
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
    return {rates.velocity, rates.omega, relative_inertia(configuration.pose) * rates.omega,
            has_tail() ? tail_velocities(configuration, rates) : NodalField<dim>()};
  }

  template <int dim>
  Tensor<2, n_rotations<dim>> Swimmer<dim>::relative_inertia(const Attitude<dim> &attitude) const
  {
    Tensor<2, n_rotations<dim>> inertia = unit_symmetric_tensor<n_rotations<dim>>();
    if constexpr (dim == 3)
    {
      const auto           moments = scene_.head.second_moments();
      const Tensor<2, dim> R       = attitude.rotation();
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          inertia[i][j] = moments[i][j] / scene_.head.second_moment(dim);
      inertia = R * inertia * transpose(R);
    }
    return inertia;
  }

  template <int dim>
  double Swimmer<dim>::kinetic_energy(const BodyVelocities<dim> &v) const
  {
    double energy = 0.;
    if (inertia_.head)
      energy += .5 * head_mass() * v.head.norm_square() + .5 * head_moment_of_inertia() * (v.spin * v.omega);
    if (inertia_.tail)
      energy += .5 * scene_.tail->density_kg_m3 * elasticity_->norm_square(v.tail);
    return energy;
  }

  template <int dim>
  NodalField<dim> Swimmer<dim>::inertial_force_on_tail(const NodalField<dim> &acceleration) const
  {
    if (!inertia_.tail || acceleration.empty())
      return {};
    const auto     &mesh = tail().mesh;
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
    for (int c = 0; c < dim; ++c)
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
    return scene_.head.volume(dim) * effective_gravity(scene_.head.density_kg_m3, time_s);
  }

  template <int dim>
  MagneticTorque<dim> Swimmer<dim>::torque_on_head(const Attitude<dim> &attitude, const double time_s) const
  {
    Tensor<1, dim> direction;
    for (int c = 0; c < dim; ++c)
      direction[c] = scene_.head.magnetization_direction[c];
    return magnetic_torque(scene_.head.magnetization_A_m * scene_.head.volume(dim), direction, attitude,
                           scene_.field(time_s));
  }

  template <int dim>
  double Swimmer<dim>::tail_angle(const Configuration<dim> &configuration) const
  {
    if (!has_tail())
      return configuration.pose.heading();
    const auto &[before, middle, tip] = tail().axis_at_tip;
    // Derivative at its end of the quadratic through the last edge of the axis, relative to the head.
    const auto slope = [&, b = before, m = middle, t = tip](const auto &field) {
      return 3. * Tensor<1, dim>(field[t]) - 4. * Tensor<1, dim>(field[m]) + Tensor<1, dim>(field[b]);
    };
    const Tensor<1, dim> at_rest = slope(tail().mesh.nodes), tangent = at_rest + slope(configuration.shape);
    if constexpr (dim == 3)
    {
      const Tensor<1, dim> direction = configuration.pose.rotation() * turned_with(tangent, at_rest);
      return std::atan2(direction[1], direction[0]);
    }
    return configuration.pose.heading() + std::atan2(tangent[1], tangent[0]);
  }

  template MagneticTorque<2> magnetic_torque<2>(double, const Tensor<1, 2> &, const Attitude<2> &,
                                                const std::array<double, 3> &);
  template MagneticTorque<3> magnetic_torque<3>(double, const Tensor<1, 3> &, const Attitude<3> &,
                                                const std::array<double, 3> &);

  template class Swimmer<2>;
  template class Swimmer<3>;
} // namespace swimtwin
