#include <fom/fluid/fluid_domain.h>

#include <datasets/scene/dimensionless_groups.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// One mesh needs one matrix, whose factors serve all its positions; the partitioned scheme may iterate.
    LinearSolver solver_of_mesh_motion(const Scene &scene)
    {
      return scene.is_partitioned() && scene.numerics.linear_solver == LinearSolver::iterative ? LinearSolver::iterative
                                                                                               : LinearSolver::direct;
    }
  } // namespace

  template <int dim>
  FluidDomain<dim>::FluidDomain(const Scene &scene, FluidMesh<dim> fluid_mesh, const RigidPose<dim> &pose)
      : scene_(scene), fluid_mesh_(std::move(fluid_mesh)), numbering_(fluid_mesh_.mesh, true),
        mirror_pairs_(fluid_mesh_.mesh, fluid_mesh_.image_of_vertex), pose_at_meshing_(pose), positions_(mesh().nodes),
        pressure_scale_(scene.fluid->viscosity_Pa_s / scene.body_length_m()),
        quality_(worst_quality(mesh(), positions_)), terms_(inertia_terms(scene))
  {
    if (terms_.of_fluid())
    {
      past_.now    = {positions_, std::vector<Tensor<1, dim>>(mesh().n_nodes())};
      past_.before = past_.now;
    }
    is_at_surface_.assign(mesh().n_nodes(), 0);
    for (const auto node : fluid_mesh_.surface_nodes)
      is_at_surface_[node] = 1;
    for (unsigned int c = 0; c < mesh().n_cells(); ++c)
      if (mesh().is_owned(c) && !mirror_pairs_.is_image(mesh().cells[c]))
      {
        owned_cells_.push_back(c);
        if (std::any_of(mesh().cells[c].begin(), mesh().cells[c].end(),
                        [&](const unsigned int node) { return is_at_surface_[node]; }))
          owned_cells_at_surface_.push_back(c);
        map_.reinit(cell_positions<dim>(mesh().cells[c], positions_));
        for (unsigned int q = 0; q < map_.n_points(); ++q)
          volume_ += mirror_pairs_.weight() * map_.weight(q);
      }
    volume_ = Utilities::MPI::sum(volume_, mesh().communicator());
  }

  template <int dim>
  void FluidDomain<dim>::describe(MotionMap<dim> &map, const bool pin_pressure) const
  {
    for (const auto &[node, wall, name] : fluid_mesh_.wall_nodes)
      if (wall->condition != WallCondition::traction_free)
        for (int c = 0; c < dim; ++c)
          map.impose(numbering_.vector_index(node, c));
    if (pin_pressure)
      map.impose(numbering_.pressure_index(fluid_mesh_.wall_nodes.front().node));
  }

  template <int dim>
  void FluidDomain<dim>::set_wall_velocities(MotionMap<dim> &map, const double time_s) const
  {
    for (const auto &[node, wall, name] : fluid_mesh_.wall_nodes)
      if (wall->condition != WallCondition::no_slip && wall->condition != WallCondition::traction_free)
      {
        const Tensor<1, dim> v = wall_velocity(*scene_.domain, name, positions_[node], time_s);
        for (int c = 0; c < dim; ++c)
          map.imposed[numbering_.vector_index(node, c)] = v[c];
      }
  }

  template <int dim>
  std::optional<double> FluidDomain<dim>::follow(const std::vector<Point<dim>> &surface, const RigidPose<dim> &pose)
  {
    // A domain that moves with the swimmer is deformed in the head's frame, where its walls are still.
    const bool                  co_moving = scene_.domain->moves_with_swimmer;
    std::vector<Tensor<1, dim>> displacement(surface.size());
    double                      largest = 0.;
    for (unsigned int k = 0; k < surface.size(); ++k)
    {
      const Point<dim> x = co_moving ? pose_at_meshing_.to_laboratory(pose.to_head_frame(surface[k])) : surface[k];
      displacement[k]    = x - mesh().nodes[fluid_mesh_.surface_nodes[k]];
      largest            = std::max(largest, displacement[k].norm());
    }
    if (largest > 1e-14 * scene_.body_length_m())
    {
      if (!extension_)
      {
        std::vector<unsigned int> still;
        for (const auto &wall_node : fluid_mesh_.wall_nodes)
          still.push_back(wall_node.node);
        extension_ = std::make_unique<MeshExtension<dim>>(mesh(), numbering_, scene_.numerics.mesh_motion,
                                                          fluid_mesh_.surface_nodes, still, mirror_pairs_,
                                                          solver_of_mesh_motion(scene_));
      }
      const auto extended = extension_->extend(displacement);
      if (extended.empty())
        return std::nullopt;
      for (unsigned int i = 0; i < positions_.size(); ++i)
        positions_[i] = mesh().nodes[i] + extended[i];
    }
    else
      positions_ = mesh().nodes;
    if (co_moving)
      for (auto &x : positions_)
        x = pose.to_laboratory(pose_at_meshing_.to_head_frame(x));
    return quality_ = worst_quality(mesh(), positions_);
  }

  template <int dim>
  std::vector<unsigned int> FluidDomain<dim>::cell_rows(const unsigned int cell) const
  {
    std::vector<unsigned int> rows;
    for (const auto node : mesh().cells[cell])
      for (int c = 0; c < dim; ++c)
        rows.push_back(numbering_.vector_index(node, c));
    for (int v = 0; v <= dim; ++v)
      rows.push_back(numbering_.pressure_index(mesh().cells[cell][v]));
    return rows;
  }

  template <int dim>
  void FluidDomain<dim>::add_cells(Condensation<dim> &condensation) const
  {
    for (const auto c : owned_cells_)
      condensation.add_cell(cell_rows(c), mirror_pairs_.weight());
  }

  template <int dim>
  std::vector<double> FluidDomain<dim>::pressure_masses() const
  {
    const double factor = mirror_pairs_.weight() * pressure_scale_ * pressure_scale_ / scene_.fluid->viscosity_Pa_s;
    std::vector<double> masses(n_rows(), 0.);
    for (const auto c : owned_cells_)
    {
      map_.reinit(cell_positions<dim>(mesh().cells[c], positions_));
      for (int v = 0; v <= dim; ++v)
        for (unsigned int q = 0; q < map_.n_points(); ++q)
          masses[numbering_.pressure_index(mesh().cells[c][v])] +=
              factor * map_.weight(q) * map_.linear_value(q, v) * map_.linear_value(q, v);
    }
    return masses;
  }

  template <int dim>
  void FluidDomain<dim>::begin_step(const Bdf2 &bdf)
  {
    if (!terms_.of_fluid())
      return;
    const auto &[now, before] = past_;
    known_.positions.resize(mesh().n_nodes());
    known_.velocity.resize(mesh().n_nodes());
    for (unsigned int i = 0; i < mesh().n_nodes(); ++i)
    {
      known_.positions[i] = Point<dim>(bdf.known<Tensor<1, dim>>(now.positions[i], before.positions[i]));
      known_.velocity[i]  = bdf.known(now.velocity[i], before.velocity[i]);
    }
    slope_weight_          = bdf.slope_weight;
    solves_for_convection_ = terms_.convective && !convection_is_mild();
  }

  template <int dim>
  bool FluidDomain<dim>::convection_is_mild() const
  {
    // Taken from the iterate, the convective term's error shrinks in each iteration by rho U l / (rho l^2 / c + mu) for
    // a disturbance of length l: at most U sqrt(rho c / mu) / 2, at l = sqrt(mu c / rho).
    constexpr double mild  = 0.1;
    double           speed = largest_imposed_speed_m_s(scene_);
    for (unsigned int i = 0; i < mesh().n_nodes(); ++i)
      speed = std::max(speed, past_.now.velocity[i].norm());
    const double contraction =
        terms_.unsteady
            ? .5 * speed * std::sqrt(scene_.fluid->density_kg_m3 * slope_weight_ / scene_.fluid->viscosity_Pa_s)
            : scene_.fluid->density_kg_m3 * speed * scene_.body_length_m() / scene_.fluid->viscosity_Pa_s;
    return contraction < mild && !scene_.time.is_steady;
  }

  template <int dim>
  void FluidDomain<dim>::end_step(const std::vector<double> &values)
  {
    if (!terms_.of_fluid())
      return;
    past_.before        = std::move(past_.now);
    past_.now.positions = positions_;
    past_.now.velocity.resize(mesh().n_nodes());
    for (unsigned int i = 0; i < mesh().n_nodes(); ++i)
      for (int c = 0; c < dim; ++c)
        past_.now.velocity[i][c] = values[numbering_.vector_index(i, c)];
  }

  template <int dim>
  double FluidDomain<dim>::distance(const std::vector<double> &values, const std::vector<double> &others) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < mesh().n_nodes(); ++i)
      for (int c = 0; c < dim; ++c)
      {
        const auto   row        = numbering_.vector_index(i, c);
        const double difference = values[row] - (others.empty() ? 0. : others[row]);
        sum += difference * difference;
      }
    return std::sqrt(sum / mesh().n_nodes());
  }

  template <int dim>
  CellFlow<dim> FluidDomain<dim>::cell_flow(const unsigned int cell, const std::vector<double> &values) const
  {
    CellFlow<dim> flow;
    for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
    {
      const unsigned int node = mesh().cells[cell][a];
      if (!values.empty())
        for (int c = 0; c < dim; ++c)
          flow.fluid[a][c] = values[numbering_.vector_index(node, c)];
      flow.known[a]           = known_.velocity[node];
      flow.goes_with_fluid[a] = is_at_surface_[node] && !values.empty();
      flow.mesh[a] =
          flow.goes_with_fluid[a] ? flow.fluid[a] : (positions_[node] - known_.positions[node]) / slope_weight_;
    }
    return flow;
  }

  template <int dim>
  void FluidDomain<dim>::assemble(Condensation<dim> &condensation, const double source,
                                  const std::vector<double> &iterate) const
  {
    FluidCellMatrix<dim>                       K;
    std::array<double, n_fluid_cell_dofs<dim>> load{};
    const FluidInertia                         inertia = step_inertia();
    for (unsigned int k = 0; k < owned_cells_.size(); ++k)
    {
      const unsigned int cell = owned_cells_[k];
      map_.reinit(cell_positions<dim>(mesh().cells[cell], positions_));
      stokes_cell_matrix<dim>(map_, scene_.fluid->viscosity_Pa_s, pressure_scale_, K);
      load.fill(0.);
      for (int v = 0; v <= dim; ++v)
        for (unsigned int q = 0; q < map_.n_points(); ++q)
          load[n_cell_nodes<dim> * dim + v] -=
              pressure_scale_ * source / volume_ * map_.weight(q) * map_.linear_value(q, v);
      if (slope_weight_ > 0.) // of a step with inertia
      {
        const CellFlow<dim> flow = cell_flow(cell, iterate);
        if (inertia.rate_1_s > 0.)
          add_unsteady_term<dim>(map_, inertia, flow, K, load);
        if (solves_for_convection_)
          add_linearized_convection<dim>(map_, inertia, flow, K, load);
        else
          add_convection_as_load<dim>(map_, inertia, flow, load);
        if (const auto needed = stabilization(flow))
          needed->add(map_, K);
      }
      condensation.add(k, K, load);
    }
  }

  template <int dim>
  FluidReaction FluidDomain<dim>::sum_forces(const std::vector<unsigned int> &cells,
                                             const std::vector<double>       &values) const
  {
    constexpr unsigned int n_velocity = n_cell_nodes<dim> * dim;
    FluidReaction          sum{std::vector<double>(n_rows(), 0.), 0., 0., 0., {}};
    FluidCellMatrix<dim>   K;
    for (const auto c : cells)
    {
      map_.reinit(cell_positions<dim>(mesh().cells[c], positions_));
      stokes_cell_matrix<dim>(map_, scene_.fluid->viscosity_Pa_s, pressure_scale_, K);
      std::array<double, n_fluid_cell_dofs<dim>> inertial{};
      if (slope_weight_ > 0.)
      {
        const CellFlow<dim> flow = cell_flow(c, values);
        add_inertial_forces<dim>(map_, step_inertia(), flow, inertial, sum.kinetic);
        if (const auto needed = stabilization(flow))
          sum.stabilization += needed->add_forces(map_, flow, inertial);
      }
      const auto rows = cell_rows(c);
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        double viscous = 0., total = 0.;
        for (unsigned int j = 0; j < rows.size(); ++j)
        {
          total += K[i][j] * values[rows[j]];
          if (j < n_velocity)
            viscous = total;
        }
        sum.force[rows[i]] += total + inertial[i];
        if (i < n_velocity)
          sum.dissipation += values[rows[i]] * viscous;
      }
    }
    Utilities::MPI::sum(sum.force, mesh().communicator(), sum.force);
    mirror_pairs_.complete(sum.force, numbering_);
    for (double *power :
         {&sum.dissipation, &sum.stabilization, &sum.kinetic.energy, &sum.kinetic.growth, &sum.kinetic.outflow})
      *power = mirror_pairs_.weight() * Utilities::MPI::sum(*power, mesh().communicator());
    return sum;
  }

  template <int dim>
  std::vector<double> FluidDomain<dim>::force_on_fluid_at_surface(const std::vector<double> &values) const
  {
    return sum_forces(owned_cells_at_surface_, values).force;
  }

  template <int dim>
  FluidReaction FluidDomain<dim>::react(const std::vector<double> &values) const
  {
    FluidReaction reaction = sum_forces(owned_cells_, values);
    for (const auto &[node, wall, name] : fluid_mesh_.wall_nodes)
      if (wall->condition != WallCondition::traction_free)
        for (int c = 0; c < dim; ++c)
        {
          const auto row = numbering_.vector_index(node, c);
          reaction.wall_power += values[row] * reaction.force[row];
        }
    return reaction;
  }

  template class FluidDomain<2>;
  template class FluidDomain<3>;
} // namespace swimtwin
