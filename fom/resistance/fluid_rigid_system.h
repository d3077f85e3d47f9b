// Fluid and rigid motion for a surface whose shape and shape rate are given: P has the columns U and omega alone.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>
#include <fom/unknowns/turning_field.h>

#include <optional>

namespace swimtwin
{
  /// Lives as long as the fluid's mesh. In a domain closed by walls the shape rate must not change the body's area.
  template <int dim>
  class FluidRigidSystem
  {
  public:
    /// All must outlive this. `in_plane`: the head keeps to its plane, whatever the mesh. Collective.
    FluidRigidSystem(const Swimmer<dim> &swimmer, FluidDomain<dim> &fluid, LinearSystem &solver, bool head_is_free,
                     MPI_Comm communicator, bool in_plane = false);

    /// The fluid's mesh is already at the configuration; its surface moves with U + omega x r + R shape_rate. An empty
    /// rate means a frozen shape, no time walls at rest. Collective.
    void assemble(const Configuration<dim> &configuration, const NodalField<dim> &shape_rate,
                  std::optional<double> time_s);

    /// Loads on a free head and on the whole body, before `solve`: force and torque about the head's centre.
    void add_load(const dealii::Tensor<1, n_rigid<dim>> &load);
    /// What the field's torque changes by with the body's angular velocity.
    void add_torque_by_rotation(const TurningField<dim> &field);

    /// Solve from a guess. False if the linear solver failed. Collective.
    bool solve(std::vector<double> &unknowns);

    /// As of the coupled system; with its shape rate given, the body resists more than with a tail that yields.
    bool field_outruns_step();

    /// Which of U and omega a free head has, by their places there: all, or, on a mesh that is its own mirror image in
    /// space, those in its plane.
    const std::vector<int> &motions() const { return motions_; }
    /// U and omega; zero for a fixed head.
    dealii::Tensor<1, n_rigid<dim>> rigid_velocity(const std::vector<double> &unknowns) const;
    /// Fluid rows' values (velocities, scaled pressures), at the configuration last assembled.
    std::vector<double> fluid_values(const std::vector<double> &unknowns) const;
    unsigned int        n_unknowns() const { return map_.n_unknowns(); }

  private:
    bool owns_head() const { return map_.head_is_free() && map_.last_owned() == map_.n_unknowns(); }

    const Swimmer<dim> &swimmer_;
    FluidDomain<dim>   &fluid_;
    LinearSystem       &solver_;
    MotionMap<dim>      map_;
    Condensation<dim>   condensation_;
    std::vector<int>    motions_;
    struct RotationEntry
    {
      int          row, column; ///< rotations
      unsigned int entry;
    };
    std::vector<RotationEntry> rotation_entries_; ///< of the rank that has the head
    TurningField<dim>          turning_field_;
  };
} // namespace swimtwin
