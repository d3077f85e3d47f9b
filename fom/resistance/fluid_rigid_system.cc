#include <fom/resistance/fluid_rigid_system.h>

#include <fom/fluid/fluid_blocks.h>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  FluidRigidSystem<dim>::FluidRigidSystem(const Swimmer<dim> &swimmer, FluidDomain<dim> &fluid, LinearSystem &solver,
                                          const bool head_is_free, const MPI_Comm communicator, const bool in_plane)
      : swimmer_(swimmer), fluid_(fluid), solver_(solver), map_(fluid.n_rows(), 0, swimmer.scene().body_length_m()),
        condensation_(map_)
  {
    fluid_.describe(map_, !swimmer.scene().domain->has_traction_free_wall());
    for (unsigned int k = 0; k < swimmer_.n_surface_nodes(); ++k)
      for (int c = 0; c < dim; ++c)
        map_.tie_to_head(fluid_.surface_row(k, c), c, swimmer_.surface_at_rest(k));
    for (int k = 0; k < n_rigid<dim>; ++k)
      motions_.push_back(k);
    const bool is_mirrored = dim == 3 && !fluid.fluid_mesh().image_of_vertex.empty();
    if (is_mirrored)
      fluid_.describe_mirror(map_);
    if (is_mirrored || (dim == 3 && in_plane))
    {
      motions_ = motions_in_plane<dim>;
      map_.keep_head_to(motions_);
    }
    std::vector<unsigned int> owner;
    for (unsigned int row = 0; row < fluid_.n_rows(); ++row)
      owner.push_back(fluid_.row_owner(row));
    map_.close(owner, head_is_free, communicator);
    fluid_.add_cells(condensation_);
    if (owns_head())
      for (const int k : motions_)
        for (const int l : motions_)
          if (k >= dim && l >= dim)
            rotation_entries_.push_back(
                {k - dim, l - dim, condensation_.add_entry(*map_.head_unknown(k), *map_.head_unknown(l))});
    condensation_.lay_out(solver_);
    if (solver_.is_iterative())
      solver_.set_kinds(own_kinds(fluid_, map_));
  }

  template <int dim>
  void FluidRigidSystem<dim>::assemble(const Configuration<dim> &configuration, const NodalField<dim> &shape_rate,
                                       const std::optional<double> time_s)
  {
    const Tensor<2, dim> R = configuration.pose.rotation();
    for (unsigned int k = 0; k < swimmer_.n_surface_nodes(); ++k)
      if (const int node = swimmer_.tail_node(k); node >= 0)
      {
        const Tensor<1, dim> X = swimmer_.surface_at_rest(k) + configuration.shape[node];
        const Tensor<1, dim> v = shape_rate.empty() ? Tensor<1, dim>() : R * shape_rate[node];
        for (int c = 0; c < dim; ++c)
        {
          const unsigned int row = fluid_.surface_row(k, c);
          map_.move_on_head(row, X);
          map_.imposed[row] = v[c];
        }
      }
    map_.set_rotation(R);
    if (time_s)
      fluid_.set_wall_velocities(map_, *time_s);
    condensation_.reset();
    fluid_.assemble(condensation_);
  }

  template <int dim>
  void FluidRigidSystem<dim>::add_load(const Tensor<1, n_rigid<dim>> &load)
  {
    if (owns_head())
      for (const int k : motions_)
        condensation_.right_hand_side()[*map_.head_unknown(k)] += k < dim ? load[k] : load[k] / map_.length_scale();
  }

  template <int dim>
  void FluidRigidSystem<dim>::add_torque_by_rotation(const TurningField<dim> &field)
  {
    turning_field_ = field;
    for (const auto &[k, l, entry] : rotation_entries_)
      condensation_.add_to_entry(entry, -field.torque_by_rate[k][l] / (map_.length_scale() * map_.length_scale()));
  }

  template <int dim>
  bool FluidRigidSystem<dim>::solve(std::vector<double> &unknowns)
  {
    solver_.set_matrix(condensation_.values());
    solver_.set_right_hand_side(condensation_.right_hand_side());
    if (solver_.is_iterative())
      solver_.set_masses(pressure_masses(fluid_, map_));
    return solver_.solve(unknowns);
  }

  template <int dim>
  bool FluidRigidSystem<dim>::field_outruns_step()
  {
    return outruns_step(turning_field_, map_, solver_);
  }

  template <int dim>
  Tensor<1, n_rigid<dim>> FluidRigidSystem<dim>::rigid_velocity(const std::vector<double> &unknowns) const
  {
    Tensor<1, n_rigid<dim>> velocity;
    if (map_.head_is_free())
      for (const int k : motions_)
        velocity[k] = unknowns[*map_.head_unknown(k)] / (k < dim ? 1. : map_.length_scale());
    return velocity;
  }

  template <int dim>
  std::vector<double> FluidRigidSystem<dim>::fluid_values(const std::vector<double> &unknowns) const
  {
    std::vector<double> rows = map_.expand(unknowns);
    rows.resize(fluid_.n_rows()); // the head's follow
    return rows;
  }

  template class FluidRigidSystem<2>;
  template class FluidRigidSystem<3>;
} // namespace swimtwin
