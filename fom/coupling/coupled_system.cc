#include <fom/coupling/coupled_system.h>

#include <datasets/scene/mirror_plane.h>
#include <fom/body/tail_rows.h>
#include <fom/fluid/fluid_blocks.h>
#include <fom/geometry/turns_in_plane.h>

#include <deal.II/base/mpi.h>

#include <numeric>
#include <utility>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::unique_ptr<NodeNumbering<dim>> number_tail(const Swimmer<dim> &swimmer)
    {
      return swimmer.has_tail() ? std::make_unique<NodeNumbering<dim>>(swimmer.tail().mesh, false) : nullptr;
    }
  } // namespace

  template <int dim>
  CoupledSystem<dim>::CoupledSystem(const Swimmer<dim> &swimmer, FluidDomain<dim> *fluid, LinearSystem &system,
                                    const MPI_Comm communicator)
      : swimmer_(swimmer), fluid_(fluid), system_(system), n_fluid_rows_(fluid ? fluid->n_rows() : 0),
        rank_(Utilities::MPI::this_mpi_process(communicator)), n_ranks_(Utilities::MPI::n_mpi_processes(communicator)),
        tail_numbering_(number_tail(swimmer)), map_(n_fluid_rows_, n_tail_rows(), swimmer.scene().body_length_m()),
        condensation_(map_)
  {
    if (tail_numbering_)
      describe_tail();
    if (fluid_)
    {
      // A tail that can change its area fixes the pressure's level by itself; a rigid body in a closed domain does not.
      fluid_->describe(map_, !swimmer.can_bend() && !swimmer.scene().domain->has_traction_free_wall());
      describe_surface();
    }
    if (solves_half(swimmer.scene()))
      describe_mirror();
    else if (moves_in_plane(swimmer.scene()))
      map_.keep_head_to(motions_in_plane<dim>);
    std::vector<unsigned int> owner;
    for (unsigned int row = 0; row < n_fluid_rows_; ++row)
      owner.push_back(fluid_->row_owner(row));
    for (unsigned int row = 0; row < n_tail_rows(); ++row)
      owner.push_back(tail_numbering_->owner(row % tail_numbering_->size()));
    map_.close(owner, swimmer.scene().head.is_free(), communicator);
    lay_out();
  }

  template <int dim>
  void CoupledSystem<dim>::lay_out()
  {
    if (fluid_)
      fluid_->add_cells(condensation_);
    if (tail_numbering_)
    {
      const auto &mesh = swimmer_.tail().mesh;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (mesh.is_owned(c) && !tail_pairs_.is_image(mesh.cells[c]))
        {
          std::vector<unsigned int> rows;
          for (const auto node : mesh.cells[c])
            for (int i = 0; i < dim; ++i)
              rows.push_back(tail_row(node, i));
          const auto number = condensation_.add_cell(rows, tail_pairs_.weight());
          if (tail_cells_.empty())
            first_tail_cell_ = number;
          tail_cells_.push_back(c);
        }
      first_mass_cell_ = first_tail_cell_ + tail_cells_.size();
      for (const auto c : tail_cells_)
        if (swimmer_.inertia().tail)
        {
          std::vector<unsigned int> rows;
          for (const auto node : mesh.cells[c])
            for (int i = 0; i < dim; ++i)
              rows.push_back(moving_row(node, i));
          condensation_.add_cell(rows, tail_pairs_.weight());
        }
    }
    for (unsigned int i = 0; rank_ + 1 == n_ranks_ && i < map_.n_head_unknowns(); ++i)
    {
      auto &row = head_entries_.emplace_back(map_.n_head_unknowns(), 0);
      for (unsigned int j = 0; j < map_.n_head_unknowns(); ++j)
        if (i == j || (map_.head_component(i) >= dim && map_.head_component(j) >= dim))
          row[j] = condensation_.add_entry(map_.first_head_unknown() + i, map_.first_head_unknown() + j);
    }
    condensation_.lay_out(system_);
    if (fluid_ && system_.is_iterative())
      system_.set_kinds(own_kinds(*fluid_, map_));
    else if (fluid_ && moves_in_plane(swimmer_.scene()))
      describe_axes();
  }

  template <int dim>
  void CoupledSystem<dim>::describe_axes()
  {
    std::vector<TurnedAxes::Pair> pairs;
    std::vector<char>             is_taken(map_.n_unknowns(), false);
    // A vector of its own, not an image or tied to others; the head's comes last.
    const auto add = [&](const unsigned int x, const unsigned int y) {
      const auto own = [&](const unsigned int row) {
        return map_.end(row) - map_.begin(row) == 1 && map_.begin(row)->coefficient == 1. &&
               map_.begin(row)->unknown >= map_.first_owned() && map_.begin(row)->unknown < map_.last_owned() &&
               map_.begin(row)->unknown < map_.first_head_unknown();
      };
      if (!own(x) || !own(y) || std::exchange(is_taken[map_.begin(x)->unknown], true))
        return false;
      pairs.push_back({static_cast<PetscInt>(map_.begin(x)->unknown), static_cast<PetscInt>(map_.begin(y)->unknown)});
      return true;
    };
    for (unsigned int i = 0; i < fluid_->mesh().n_nodes(); ++i)
      if (add(fluid_->numbering().vector_index(i, 0), fluid_->numbering().vector_index(i, 1)))
        turning_fluid_nodes_.push_back(i);
    for (unsigned int a = 0; swimmer_.has_tail() && a < swimmer_.tail().mesh.n_nodes(); ++a)
      if (add(tail_row(a, 0), tail_row(a, 1)))
        ++n_turning_tail_nodes_;
    const auto x = map_.head_unknown(0), y = map_.head_unknown(1);
    head_turns_ = x && y && *x >= map_.first_owned() && *x < map_.last_owned();
    if (head_turns_)
      pairs.push_back({static_cast<PetscInt>(*x), static_cast<PetscInt>(*y)});
    system_.set_axes(std::move(pairs));
  }

  template <int dim>
  std::vector<double> CoupledSystem<dim>::turns(const Configuration<dim> &configuration) const
  {
    std::vector<double>       angles;
    const std::vector<double> of_fluid = turns_in_plane(fluid_->mesh(), fluid_->positions());
    for (const unsigned int i : turning_fluid_nodes_)
      angles.push_back(of_fluid[i]);
    // A tail turns as a whole, or what is stiff in it would not fit.
    const Tensor<2, dim> R     = configuration.pose.rotation();
    const double         angle = std::atan2(R[1][0], R[0][0]);
    angles.insert(angles.end(), n_turning_tail_nodes_ + head_turns_, angle);
    return angles;
  }

  template <int dim>
  void CoupledSystem<dim>::describe_tail()
  {
    // Rows of the tail hold w - omega x r: elastic forces do not feel the head's rotation, and the matrix is symmetric.
    for (unsigned int a = 0; a < swimmer_.tail().mesh.n_nodes(); ++a)
      for (int c = 0; c < dim; ++c)
        if (swimmer_.is_clamped(a))
          map_.tie(tail_row(a, c), {map_.head_row(c)});
    tie_linear_tail(map_, swimmer_,
                    [this](const unsigned int node, const unsigned int c) { return tail_row(node, c); });
    if (swimmer_.inertia().tail)
      for (unsigned int a = 0; a < swimmer_.tail().mesh.n_nodes(); ++a)
        for (int c = 0; c < dim; ++c)
          map_.tie_and_turn(moving_row(a, c), tail_row(a, c), c, swimmer_.tail().mesh.nodes[a]);
  }

  template <int dim>
  void CoupledSystem<dim>::describe_surface()
  {
    for (unsigned int k = 0; k < swimmer_.n_surface_nodes(); ++k)
      for (int c = 0; c < dim; ++c)
      {
        const int node = swimmer_.tail_node(k);
        if (node < 0)
          map_.tie_to_head(fluid_->surface_row(k, c), c, swimmer_.surface_at_rest(k));
        else
          map_.tie_and_turn(fluid_->surface_row(k, c), tail_row(node, c), c, swimmer_.surface_at_rest(k));
      }
  }

  template <int dim>
  void CoupledSystem<dim>::move_surface(const Configuration<dim> &configuration)
  {
    for (unsigned int k = 0; fluid_ && k < swimmer_.n_surface_nodes(); ++k)
      if (const int node = swimmer_.tail_node(k); node >= 0)
        for (int c = 0; c < dim; ++c)
          map_.move_on_head(fluid_->surface_row(k, c), swimmer_.surface_at_rest(k) + configuration.shape[node]);
    if (tail_numbering_ && swimmer_.inertia().tail)
      for (unsigned int a = 0; a < configuration.shape.size(); ++a)
        for (int c = 0; c < dim; ++c)
          map_.move_on_head(moving_row(a, c), swimmer_.tail().mesh.nodes[a] + configuration.shape[a]);
    map_.set_rotation(configuration.pose.rotation());
  }

  template <int dim>
  void CoupledSystem<dim>::give_motion(const LinearizationPoint<dim> &point)
  {
    const Scene &scene = swimmer_.scene();
    if (scene.head.is_driven())
    {
      for (int c = 0; c < dim; ++c)
        map_.give(map_.head_row(c), point.rates.velocity[c]);
      for (int k = 0; k < n_rotations<dim>; ++k)
        map_.give(map_.head_row(dim + k), point.rates.omega[k]);
    }
    if (scene.tail && scene.tail->is_driven())
    {
      const Tensor<2, dim> R = point.configuration.pose.rotation();
      for (unsigned int a = 0; a < point.rates.shape_rate.size(); ++a)
      {
        const Tensor<1, dim> v = R * point.rates.shape_rate[a];
        for (int c = 0; c < dim; ++c)
          map_.give(tail_row(a, c), v[c]);
      }
    }
  }

  template <int dim>
  void CoupledSystem<dim>::describe_mirror()
  {
    // In the plane: along the line that is left of it in 2D, and in the plane of x and y in 3D.
    map_.keep_head_to(dim == 2 ? std::vector<int>{0} : motions_in_plane<dim>);
    if (tail_numbering_)
    {
      tail_pairs_ = MirrorPairs<dim>(swimmer_.tail().mesh, swimmer_.tail().image_of_vertex);
      tail_pairs_.describe(map_, *tail_numbering_, false, n_fluid_rows_);
    }
    if (fluid_)
      fluid_->describe_mirror(map_);
  }

  template <int dim>
  bool CoupledSystem<dim>::solve(const LinearizationPoint<dim> &point, std::vector<double> &unknowns)
  {
    give_motion(point);
    move_surface(point.configuration);
    if (fluid_)
      fluid_->set_wall_velocities(map_, point.time_s);
    condensation_.reset();
    const bool                is_carried = fluid_ && fluid_->inertia().of_fluid();
    const std::vector<double> iterate    = is_carried ? map_.expand(unknowns) : std::vector<double>();
    if (fluid_)
      fluid_->assemble(condensation_, -point.area_rate, iterate);
    if (tail_numbering_)
      assemble_tail(point);
    if (map_.head_is_free())
      assemble_head(point);
    if (point.known_velocities && swimmer_.inertia().tail)
      assemble_tail_inertia(point);
    if (point.known_velocities && swimmer_.inertia().head && map_.head_is_free())
      assemble_head_inertia(point);
    if (system_.has_axes())
      system_.turn_axes(turns(point.configuration));
    system_.set_matrix(condensation_.values(), !(fluid_ && fluid_->solves_for_convection()));
    system_.set_right_hand_side(condensation_.right_hand_side());
    if (fluid_ && system_.is_iterative())
      system_.set_masses(pressure_masses(*fluid_, map_));
    if (!system_.solve(unknowns))
      return false;
    if (is_carried)
    {
      const std::vector<double> next = map_.expand(unknowns);
      flow_change_                   = {fluid_->distance(next, iterate), fluid_->distance(next)};
    }
    return true;
  }

  template <int dim>
  bool CoupledSystem<dim>::field_outruns_step()
  {
    return outruns_step(turning_field_, map_, system_);
  }

  template <int dim>
  void CoupledSystem<dim>::add_to_rotations(const Tensor<2, n_rotations<dim>> &block, const double divisor)
  {
    for (unsigned int i = 0; i < map_.n_head_unknowns(); ++i)
      for (unsigned int j = 0; j < map_.n_head_unknowns(); ++j)
        if (const int k = map_.head_component(i) - dim, l = map_.head_component(j) - dim; k >= 0 && l >= 0)
          condensation_.add_to_entry(head_entries_[i][j], block[k][l] / divisor);
  }

  template <int dim>
  typename CoupledSystem<dim>::TailCellSystem
  CoupledSystem<dim>::linearize_tail_cell(const unsigned int cell, const LinearizationPoint<dim> &point) const
  {
    // Internal forces on the geometry x_k, linear in the velocities v = U + R_k d' of the cell's nodes:
    // R_k f(d) ~ R_k (f(d_k) + slope K (R_k^T v - d'_k)); what all nodes have in common, U, changes nothing.
    constexpr unsigned int                 n     = ElasticTail<dim>::n_cell_dofs;
    const auto                            &nodes = swimmer_.tail().mesh.cells[cell];
    const Tensor<2, dim>                   R     = point.configuration.pose.rotation();
    TailCellSystem                         system;
    typename ElasticTail<dim>::CellForce   force;
    typename ElasticTail<dim>::CellTangent K;
    swimmer_.elasticity().cell_force_and_tangent(cell, point.configuration.shape, force, K);
    for (unsigned int a = 0; a < nodes.size(); ++a)
    {
      Tensor<1, dim> f;
      for (int i = 0; i < dim; ++i)
        f[i] = -force[a * dim + i];
      for (unsigned int b = 0; b < nodes.size(); ++b)
      {
        Tensor<2, dim> block;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            block[i][j] = point.slope_weight * K[a * dim + i][b * dim + j];
        f += block * point.rates.shape_rate[nodes[b]];
        block = R * block * transpose(R);
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            system.matrix[a * dim + i][b * dim + j] = block[i][j];
      }
      f = R * f;
      for (int i = 0; i < dim; ++i)
        system.load[a * dim + i] = f[i];
    }
    static_assert(n == TailCellSystem::size);
    return system;
  }

  template <int dim>
  void CoupledSystem<dim>::assemble_tail(const LinearizationPoint<dim> &point)
  {
    for (unsigned int number = 0; number < tail_cells_.size(); ++number)
    {
      const TailCellSystem system = linearize_tail_cell(tail_cells_[number], point);
      condensation_.add(first_tail_cell_ + number, system.matrix, system.load);
    }
    for (unsigned int a = 0; a < swimmer_.tail().mesh.n_nodes(); ++a)
      add_dead_load(a, point);
  }

  template <int dim>
  void CoupledSystem<dim>::assemble_tail_inertia(const LinearizationPoint<dim> &point)
  {
    // rho (w - w*) / c on the whole velocities w of the nodes.
    const double density_rate = swimmer_.scene().tail->density_kg_m3 / point.slope_weight;
    for (unsigned int number = 0; number < tail_cells_.size(); ++number)
    {
      const auto    &nodes = swimmer_.tail().mesh.cells[tail_cells_[number]];
      TailCellSystem system;
      for (auto &row : system.matrix)
        row.fill(0.);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int b = 0; b < nodes.size(); ++b)
        {
          const double m = density_rate * swimmer_.elasticity().cell_mass(tail_cells_[number], a, b);
          for (int i = 0; i < dim; ++i)
          {
            system.matrix[a * dim + i][b * dim + i] = m;
            system.load[a * dim + i] += m * point.known_velocities->tail[nodes[b]][i];
          }
        }
      condensation_.add(first_mass_cell_ + number, system.matrix, system.load);
    }
  }

  template <int dim>
  void CoupledSystem<dim>::add_dead_load(const unsigned int node, const LinearizationPoint<dim> &point)
  {
    const Tensor<1, dim> load = swimmer_.load_on_tail_node(node, point.time_s);
    const Tensor<1, dim> r =
        point.configuration.pose.rotation() * (swimmer_.tail().mesh.nodes[node] + point.configuration.shape[node]);
    for (int c = 0; c < dim; ++c)
      if (tail_numbering_->owner(tail_numbering_->vector_index(node, c)) == rank_)
      {
        map_.add_load(tail_row(node, c), load[c], condensation_.right_hand_side());
        for (int k = 0; k < n_rotations<dim>; ++k)
        {
          AngularVelocity<dim> axis;
          axis[k] = 1.;
          map_.add_load(map_.head_row(dim + k), rotational_velocity<dim>(axis, r)[c] * load[c],
                        condensation_.right_hand_side());
        }
      }
  }

  template <int dim>
  void CoupledSystem<dim>::assemble_head(const LinearizationPoint<dim> &point)
  {
    const auto [torque, derivative, axis] = swimmer_.torque_on_head(point.configuration.pose, point.time_s);
    turning_field_                        = {derivative * point.slope_weight, axis};
    if (rank_ + 1 != n_ranks_)
      return;
    const double         length = map_.length_scale();
    auto                &rhs    = condensation_.right_hand_side();
    const Tensor<1, dim> force  = swimmer_.force_on_head(point.time_s);
    for (int c = 0; c < dim; ++c)
      if (const auto unknown = map_.head_unknown(c))
        rhs[*unknown] += force[c];
    const AngularVelocity<dim> known_torque = torque - turning_field_.torque_by_rate * point.rates.omega;
    for (int k = 0; k < n_rotations<dim>; ++k)
      if (const auto unknown = map_.head_unknown(dim + k))
        rhs[*unknown] += known_torque[k] / length;
    add_to_rotations(-turning_field_.torque_by_rate, length * length);
  }

  template <int dim>
  void CoupledSystem<dim>::assemble_head_inertia(const LinearizationPoint<dim> &point)
  {
    if (rank_ + 1 != n_ranks_)
      return;
    // Of the angular momentum: the spin is the relative inertia, as it is turned now, times omega.
    const double length = map_.length_scale(), mass = swimmer_.head_mass() / point.slope_weight,
                 moment      = swimmer_.head_moment_of_inertia() / (point.slope_weight * length * length);
    const auto        &known = *point.known_velocities;
    auto              &rhs   = condensation_.right_hand_side();
    const unsigned int first = map_.first_head_unknown();
    for (unsigned int i = 0; i < map_.n_head_unknowns(); ++i)
    {
      const int k = map_.head_component(i);
      if (k < dim)
        condensation_.add_to_entry(head_entries_[i][i], mass);
      rhs[first + i] += k < dim ? mass * known.head[k] : moment * known.spin[k - dim] * length;
    }
    add_to_rotations(moment * swimmer_.relative_inertia(point.configuration.pose), 1.);
  }

  template <int dim>
  CoupledVelocities<dim> CoupledSystem<dim>::velocities(const std::vector<double> &unknowns) const
  {
    CoupledVelocities<dim> v;
    for (int k = 0; k < n_rigid<dim>; ++k)
      if (const double value = map_.value(map_.head_row(k), unknowns); k < dim)
        v.head_velocity[k] = value;
      else
        v.head_omega[k - dim] = value;
    if (tail_numbering_)
    {
      v.tail.resize(swimmer_.tail().mesh.n_nodes());
      for (unsigned int a = 0; a < v.tail.size(); ++a)
        for (int c = 0; c < dim; ++c)
          v.tail[a][c] = map_.value(tail_row(a, c), unknowns);
    }
    return v;
  }

  template <int dim>
  std::vector<double> CoupledSystem<dim>::guess(const CoupledVelocities<dim> &v) const
  {
    std::vector<double> unknowns(map_.n_unknowns(), 0.);
    for (unsigned int i = 0; i < map_.n_head_unknowns(); ++i)
    {
      const int k = map_.head_component(i);
      unknowns[map_.first_head_unknown() + i] =
          k < dim ? v.head_velocity[k] : v.head_omega[k - dim] * map_.length_scale();
    }
    const auto set = [&](const unsigned int row, const double value) {
      if (map_.end(row) - map_.begin(row) == 1 && map_.begin(row)->coefficient != 0.)
        unknowns[map_.begin(row)->unknown] = value / map_.begin(row)->coefficient;
    };
    for (unsigned int i = 0; fluid_ && fluid_->inertia().of_fluid() && i < fluid_->mesh().n_nodes(); ++i)
      for (int c = 0; c < dim; ++c)
        set(fluid_->numbering().vector_index(i, c), fluid_->past().now.velocity[i][c]);
    for (unsigned int a = 0; a < v.tail.size(); ++a)
      for (int c = 0; c < dim; ++c)
        if (!swimmer_.is_clamped(a))
          set(tail_row(a, c), v.tail[a][c]);
    return unknowns;
  }

  template class CoupledSystem<2>;
  template class CoupledSystem<3>;
} // namespace swimtwin
