#include <fom/resistance/motion_inertia.h>

#include <datasets/system/error.h>
#include <fom/resistance/surface_problem.h>

#include <algorithm>
#include <cmath>

// Letters: u_j flow of unit motion j, V_j its velocities on the body, m_k velocity of the mesh that follows motion k,
// u_j' how u_j changes at the nodes of that mesh, w_i the flow under the load u_i.

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    using Matrices = std::vector<FullMatrix<double>>;

    constexpr int rotation = 2; ///< among the motions in the plane

    Matrices zeros(const unsigned int n)
    {
      return Matrices(n, FullMatrix<double>(n, n));
    }

    /// How the velocity of unit motion j at a material point changes as the body moves along motion k: head frame.
    template <int dim>
    Tensor<1, dim> acceleration(const BodyMotions<dim> &motions, const int j, const int k, const int tail_node,
                                const std::vector<Tensor<1, dim>> &velocity)
    {
      const auto turned = [](const Tensor<1, dim> &v) { return unit_motion_in_plane<dim>(rotation, v); };
      if (k < rotation)
        return {};
      if (k == rotation)
        return turned(velocity[j]);
      if (j < rotation || tail_node < 0)
        return {};
      if (j == rotation)
        return turned(motions.modes[k - n_rigid_in_plane][tail_node]);
      return motions.slopes[j - n_rigid_in_plane][k - n_rigid_in_plane][tail_node];
    }

    /// Velocities of all unit motions at a point X of the body, head frame.
    template <int dim>
    std::vector<Tensor<1, dim>> unit_velocities(const BodyMotions<dim> &motions, const Tensor<1, dim> &X,
                                                const int tail_node)
    {
      std::vector<Tensor<1, dim>> velocity;
      for (int k = 0; k < n_rigid_in_plane; ++k)
        velocity.push_back(unit_motion_in_plane<dim>(k, X));
      velocity.resize(n_rigid_in_plane + motions.modes.size());
      if (tail_node >= 0)
        for (unsigned int k = 0; k < motions.modes.size(); ++k)
          velocity[n_rigid_in_plane + k] = motions.modes[k][tail_node];
      return velocity;
    }

    /// One field per motion, on the nodes of the fluid's mesh.
    template <int dim>
    using NodeFields = std::vector<std::vector<Tensor<1, dim>>>;

    /// The mesh's velocities as it follows each motion: walls stay, or go along with a domain that does.
    template <int dim>
    NodeFields<dim> mesh_velocities(const FluidDomain<dim> &fluid, const Scene &scene, const RigidPose<dim> &pose,
                                    const std::vector<SurfaceVelocity<dim>> &motions)
    {
      const bool                co_moving = scene.domain->moves_with_swimmer;
      std::vector<unsigned int> still;
      for (const auto &wall_node : fluid.fluid_mesh().wall_nodes)
        still.push_back(wall_node.node);
      MeshExtension<dim> extension(fluid.mesh(), fluid.numbering(), scene.numerics.mesh_motion,
                                   fluid.fluid_mesh().surface_nodes, still, fluid.mirror_pairs());
      NodeFields<dim>    fields;
      for (unsigned int k = 0; k < motions.size(); ++k)
        if (co_moving && k < n_rigid_in_plane)
        {
          auto &field = fields.emplace_back();
          for (const auto &x : fluid.positions())
          {
            const auto X = pose.to_head_frame(x);
            field.push_back(pose.rotation() * unit_velocities<dim>({}, X, -1)[k]);
          }
        }
        else
        {
          fields.push_back(extension.extend(motions[k]));
          if (fields.back().empty())
            throw ComputationError("the mesh could not follow the body's motions: change [numerics] mesh_size_m");
        }
      return fields;
    }

    /// Flows on one cell at one quadrature point.
    template <int dim>
    struct PointFlows
    {
      std::vector<Tensor<1, dim>> u, m;
      std::vector<Tensor<2, dim>> grad_u, grad_w, grad_m;
      std::vector<double>         p, pi;

      explicit PointFlows(const unsigned int n) : u(n), m(n), grad_u(n), grad_w(n), grad_m(n), p(n), pi(n) {}
    };

    /// Integrals over the fluid of flows, adjoint flows and mesh velocities.
    template <int dim>
    class InertiaIntegrals
    {
    public:
      InertiaIntegrals(const FluidDomain<dim> &fluid, const double viscosity, const std::vector<std::vector<double>> &u,
                       const std::vector<std::vector<double>> &w, const NodeFields<dim> &m)
          : fluid_(fluid), viscosity_(viscosity), u_(u), w_(w), m_(m), n_(u.size()), at_(n_), flow_changes_(zeros(n_)),
            convection_(zeros(n_)), dilatation_(zeros(n_)), mass_(n_, n_)
      {
        for (const auto c : fluid.owned_cells())
          add(c);
        add_up(mass_);
        for (Matrices *forms : {&flow_changes_, &convection_, &dilatation_})
          for (auto &form : *forms)
            add_up(form);
      }

      // Entry [i](j, k):
      const Matrices &flow_changes() const { return flow_changes_; } ///< - d/dy_k of the Stokes form of (u_j, w_i)
      const Matrices &convection() const { return convection_; }     ///< int u_i . ((u_k - m_k) . grad) u_j
      const Matrices &dilatation() const { return dilatation_; }     ///< int u_i . u_j div m_k
      const FullMatrix<double> &mass() const { return mass_; }       ///< int u_i . u_j

    private:
      /// Over all ranks, and over the cells that those integrated stand for.
      void add_up(FullMatrix<double> &form) const
      {
        Utilities::MPI::sum(form, fluid_.mesh().communicator(), form);
        form *= fluid_.mirror_pairs().weight();
      }

      void add(const unsigned int cell)
      {
        map_.reinit(cell_positions<dim>(fluid_.mesh().cells[cell], fluid_.positions()));
        const auto rows = fluid_.cell_rows(cell);
        for (unsigned int q = 0; q < map_.n_points(); ++q)
        {
          evaluate(fluid_.mesh().cells[cell], rows, q);
          add_point(map_.weight(q));
        }
      }

      void evaluate(const CellNodes<dim> &nodes, const std::vector<unsigned int> &rows, const unsigned int q)
      {
        at_ = PointFlows<dim>(n_);
        for (unsigned int j = 0; j < n_; ++j)
        {
          for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          {
            Tensor<1, dim> u, w;
            for (int c = 0; c < dim; ++c)
            {
              u[c] = u_[j][rows[a * dim + c]];
              w[c] = w_[j][rows[a * dim + c]];
            }
            at_.u[j] += map_.value(q, a) * u;
            at_.m[j] += map_.value(q, a) * m_[j][nodes[a]];
            at_.grad_u[j] += outer_product(u, map_.gradient(q, a));
            at_.grad_w[j] += outer_product(w, map_.gradient(q, a));
            at_.grad_m[j] += outer_product(m_[j][nodes[a]], map_.gradient(q, a));
          }
          for (int v = 0; v <= dim; ++v)
          {
            const double value = fluid_.pressure_scale() * map_.linear_value(q, v);
            at_.p[j] += value * u_[j][rows[n_cell_nodes<dim> * dim + v]];
            at_.pi[j] += value * w_[j][rows[n_cell_nodes<dim> * dim + v]];
          }
        }
      }

      void add_point(const double weight)
      {
        for (unsigned int i = 0; i < n_; ++i)
          for (unsigned int j = 0; j < n_; ++j)
            mass_(i, j) += weight * (at_.u[i] * at_.u[j]);
        for (unsigned int k = 0; k < n_; ++k)
        {
          const Tensor<2, dim> &M          = at_.grad_m[k];
          const double          dilatation = trace(M);
          for (unsigned int j = 0; j < n_; ++j)
          {
            // The derivative of int 2 mu D(u):D(w) - p div w - pi div u on a mesh that moves by m: gradients change by
            // - grad u grad m, volumes by div m.
            const Tensor<2, dim> changed = at_.grad_u[j] * M, D = .5 * (at_.grad_u[j] + transpose(at_.grad_u[j]));
            const Tensor<2, dim> stress_change =
                2. * viscosity_ * (dilatation * D - .5 * (changed + transpose(changed)) - D * transpose(M)) -
                at_.p[j] * (dilatation * Tensor<2, dim>(unit_symmetric_tensor<dim>()) - transpose(M));
            const double         flux_change = dilatation * trace(at_.grad_u[j]) - trace(changed);
            const Tensor<1, dim> carried     = at_.grad_u[j] * (at_.u[k] - at_.m[k]);
            for (unsigned int i = 0; i < n_; ++i)
            {
              flow_changes_[i](j, k) -=
                  weight * (scalar_product(at_.grad_w[i], stress_change) - at_.pi[i] * flux_change);
              convection_[i](j, k) += weight * (at_.u[i] * carried);
              dilatation_[i](j, k) += weight * dilatation * (at_.u[i] * at_.u[j]);
            }
          }
        }
      }

      const FluidDomain<dim>                 &fluid_;
      double                                  viscosity_;
      const std::vector<std::vector<double>> &u_, &w_;
      const NodeFields<dim>                  &m_;
      unsigned int                            n_;
      IsoparametricCell<dim>                  map_; // u . (u . grad) u is of degree 5
      PointFlows<dim>                         at_;
      Matrices                                flow_changes_, convection_, dilatation_;
      FullMatrix<double>                      mass_;
    };

    /// int u . v for each row's v.
    template <int dim>
    std::vector<double> mass_times(const FluidDomain<dim> &fluid, const std::vector<double> &u)
    {
      std::vector<double>    load(fluid.n_rows(), 0.);
      IsoparametricCell<dim> map;
      for (const auto cell : fluid.owned_cells())
      {
        map.reinit(cell_positions<dim>(fluid.mesh().cells[cell], fluid.positions()));
        const auto rows = fluid.cell_rows(cell);
        for (unsigned int q = 0; q < map.n_points(); ++q)
          for (int c = 0; c < dim; ++c)
          {
            double value = 0.;
            for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
              value += map.value(q, a) * u[rows[a * dim + c]];
            for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
              load[rows[a * dim + c]] += map.weight(q) * map.value(q, a) * value;
          }
      }
      Utilities::MPI::sum(load, fluid.mesh().communicator(), load);
      fluid.mirror_pairs().complete(load, fluid.numbering());
      return load;
    }

    /// quadratic[i](j, k) symmetric in j and k.
    void symmetrize(Matrices &quadratic)
    {
      for (auto &Q : quadratic)
        for (unsigned int j = 0; j < Q.m(); ++j)
          for (unsigned int k = 0; k < j; ++k)
            Q(j, k) = Q(k, j) = .5 * (Q(j, k) + Q(k, j));
    }

    double largest(const Matrices &matrices)
    {
      double size = 0.;
      for (const auto &Q : matrices)
        size = std::max(size, Q.linfty_norm());
      return size;
    }

    /// quadratic less half of dM/dt xi, and of that the part with power.
    std::pair<Matrices, Matrices> split(const Matrices &quadratic, const Matrices &mass_slopes)
    {
      const unsigned int n    = quadratic.size();
      Matrices           rest = quadratic, power = zeros(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int k = 0; k < n; ++k)
            rest[i](j, k) -= .25 * (mass_slopes[k](i, j) + mass_slopes[j](i, k));
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int k = 0; k < n; ++k)
            power[i](j, k) = (rest[i](j, k) + rest[j](i, k) + rest[k](i, j)) / 3.;
      return {rest, power};
    }
  } // namespace

  template <int dim>
  Matrices MotionInertia<dim>::powerless() const
  {
    auto [rest, power] = split(quadratic, mass_slopes);
    for (unsigned int i = 0; i < rest.size(); ++i)
      rest[i].add(-1., power[i]);
    return rest;
  }

  template <int dim>
  double MotionInertia<dim>::power_defect() const
  {
    return largest(split(quadratic, mass_slopes).second) / largest(quadratic);
  }

  template <int dim>
  MotionInertia<dim> compute_fluid_inertia(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                           const Configuration<dim> &configuration, const BodyMotions<dim> &motions)
  {
    const auto          V = surface_velocities(swimmer, configuration, motions.modes);
    const unsigned int  n = V.size();
    std::vector<double> area_rates(n, 0.);
    for (unsigned int j = 0; j < motions.modes.size(); ++j)
      area_rates[n_rigid_in_plane + j] = swimmer.volume_rate(configuration, {{}, {}, motions.modes[j]});
    SurfaceProblem<dim> problem(fluid, !swimmer.scene().domain->has_traction_free_wall());
    const auto          u = problem.flows(V, area_rates);

    std::vector<std::vector<double>> loads;
    for (const auto &flow : u)
      loads.push_back(mass_times(fluid, flow));
    const auto                  w = problem.flows_under(loads);
    const InertiaIntegrals<dim> integrals(fluid, swimmer.scene().fluid->viscosity_Pa_s, u, w,
                                          mesh_velocities(fluid, swimmer.scene(), configuration.pose, V));

    // int u_i . u_j' by the adjoint flow, with what the surface's own acceleration brings.
    Matrices             changes = integrals.flow_changes();
    const Tensor<2, dim> R       = configuration.pose.rotation();
    for (unsigned int i = 0; i < n; ++i)
    {
      const std::vector<double> reaction = fluid.force_on_fluid_at_surface(w[i]);
      for (unsigned int s = 0; s < swimmer.n_surface_nodes(); ++s)
      {
        const int      node = swimmer.tail_node(s);
        Tensor<1, dim> X    = swimmer.surface_at_rest(s), force;
        if (node >= 0)
          X += configuration.shape[node];
        for (int c = 0; c < dim; ++c)
          force[c] = loads[i][fluid.surface_row(s, c)] - reaction[fluid.surface_row(s, c)];
        const auto velocity = unit_velocities<dim>(motions, X, node);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int k = 0; k < n; ++k)
            changes[i](j, k) += force * (R * acceleration<dim>(motions, j, k, node, velocity));
      }
    }

    MotionInertia<dim> result{integrals.mass(), changes, zeros(n)};
    for (unsigned int i = 0; i < n; ++i)
    {
      result.quadratic[i].add(1., integrals.convection()[i]);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          result.mass_slopes[k](i, j) = changes[i](j, k) + changes[j](i, k) + integrals.dilatation()[i](j, k);
    }
    symmetrize(result.quadratic);
    return result;
  }

  template <int dim>
  MotionInertia<dim> compute_tail_inertia(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                          const BodyMotions<dim> &motions)
  {
    const auto                              &mesh = swimmer.tail().mesh;
    const unsigned int                       n    = n_rigid_in_plane + motions.modes.size();
    std::vector<std::vector<Tensor<1, dim>>> velocity;
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      velocity.push_back(unit_velocities<dim>(motions, mesh.nodes[a] + configuration.shape[a], a));

    MotionInertia<dim> result{FullMatrix<double>(n, n), zeros(n), zeros(n)};
    for (unsigned int i = 0; i < n; ++i) // momenta of unit motion i at the nodes
    {
      NodalField<dim> momentum(mesh.n_nodes());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
            momentum[mesh.cells[c][a]] += swimmer.elasticity().cell_mass(c, a, b) * velocity[mesh.cells[c][b]][i];
      for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
        for (unsigned int j = 0; j < n; ++j)
        {
          result.mass(i, j) += momentum[a] * velocity[a][j];
          for (unsigned int k = 0; k < n; ++k)
            result.quadratic[i](j, k) += momentum[a] * acceleration<dim>(motions, j, k, a, velocity[a]);
        }
    }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          result.mass_slopes[k](i, j) = result.quadratic[i](j, k) + result.quadratic[j](i, k);
    symmetrize(result.quadratic);
    return result;
  }

  template struct MotionInertia<2>;
  template MotionInertia<2> compute_fluid_inertia<2>(const Swimmer<2> &, const FluidDomain<2> &,
                                                     const Configuration<2> &, const BodyMotions<2> &);
  template MotionInertia<2> compute_tail_inertia<2>(const Swimmer<2> &, const Configuration<2> &,
                                                    const BodyMotions<2> &);
  template struct MotionInertia<3>;
  template MotionInertia<3> compute_fluid_inertia<3>(const Swimmer<3> &, const FluidDomain<3> &,
                                                     const Configuration<3> &, const BodyMotions<3> &);
  template MotionInertia<3> compute_tail_inertia<3>(const Swimmer<3> &, const Configuration<3> &,
                                                    const BodyMotions<3> &);
} // namespace swimtwin
