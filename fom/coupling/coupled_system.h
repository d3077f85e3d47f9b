// One linear system for fluid, tail and head velocities: the monolithic coupling, P^T A P.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>
#include <fom/unknowns/turning_field.h>

namespace swimtwin
{
  /// Point of linearisation of one coupling iteration.
  template <int dim>
  struct LinearizationPoint
  {
    const Configuration<dim>  &configuration;
    const Rates<dim>          &rates;
    double                     slope_weight; ///< d(position)/d(velocity) of the time step, s
    double                     time_s;
    double                     area_rate        = 0.; ///< that the body's surface shall have in a closed domain, m^2/s
    const BodyVelocities<dim> *known_velocities = nullptr; ///< of the time step, where the body has inertia
  };

  /// What was solved for, nodal. The tail's velocities leave out the head's rotation, so that they are those of its
  /// shape, in the laboratory's directions, beside the head's translation: U + R d'.
  template <int dim>
  struct CoupledVelocities
  {
    dealii::Tensor<1, dim> head_velocity;
    AngularVelocity<dim>   head_omega;
    NodalField<dim>        tail; ///< w - omega x R (X + d), m/s
  };

  /// Lives as long as the fluid's mesh (for ever without fluid), because its pattern does.
  template <int dim>
  class CoupledSystem
  {
  public:
    /// `fluid` may be null: a tail in vacuum. Both must outlive this. Collective.
    CoupledSystem(const Swimmer<dim> &swimmer, FluidDomain<dim> *fluid, LinearSystem &system, MPI_Comm communicator);

    /// Assemble at a point (the fluid's mesh is already there) and solve. `unknowns` holds the initial guess, then the
    /// solution. False if the linear solver failed. Collective.
    bool solve(const LinearizationPoint<dim> &point, std::vector<double> &unknowns);
    /// By how much the last solve changed the flow (root mean square, m/s), and the flow's size, where convection makes
    /// it an iterate of its own; else zero.
    struct FlowChange
    {
      double change = 0., size = 0.;
    };
    const FlowChange &flow_change() const { return flow_change_; }

    /// Whether, at the last point of linearisation, the field turns the head away from an unstable equilibrium in less
    /// time than the step. Collective.
    bool field_outruns_step();

    CoupledVelocities<dim> velocities(const std::vector<double> &unknowns) const;
    /// Unknowns with the body's velocities in their places and the fluid as it was last, at rest without a memory of
    /// it: a guess after remeshing.
    std::vector<double> guess(const CoupledVelocities<dim> &velocities) const;
    /// Rows' values: fluid (velocities, scaled pressures), then tail (without the head's rotation).
    std::vector<double> expand(const std::vector<double> &unknowns) const { return map_.expand(unknowns); }

    unsigned int n_unknowns() const { return map_.n_unknowns(); }

  private:
    void describe_tail();
    void describe_surface();
    void move_surface(const Configuration<dim> &configuration);
    void give_motion(const LinearizationPoint<dim> &point);
    void describe_mirror();
    void lay_out();
    void describe_axes();
    /// How far fluid, tail and head have turned where their vectors are unknowns.
    std::vector<double> turns(const Configuration<dim> &configuration) const;
    /// Linearised forces of one tail cell: rows and columns are its nodes' velocities without the head's rotation.
    struct TailCellSystem
    {
      static constexpr unsigned int              size = ElasticTail<dim>::n_cell_dofs;
      std::array<std::array<double, size>, size> matrix;
      std::array<double, size>                   load{};
    };
    TailCellSystem linearize_tail_cell(unsigned int cell, const LinearizationPoint<dim> &point) const;
    void           add_dead_load(unsigned int node, const LinearizationPoint<dim> &point);
    void           assemble_tail(const LinearizationPoint<dim> &point);
    void           assemble_tail_inertia(const LinearizationPoint<dim> &point);
    void           assemble_head(const LinearizationPoint<dim> &point);
    void           assemble_head_inertia(const LinearizationPoint<dim> &point);
    /// Add a block over a number to the matrix, in the rows and columns of the head's rotations.
    void         add_to_rotations(const dealii::Tensor<2, n_rotations<dim>> &block, double divisor);
    unsigned int tail_row(const unsigned int node, const unsigned int component) const
    {
      return n_fluid_rows_ + tail_numbering_->vector_index(node, component);
    }

    /// Row of a component of a tail node's whole velocity, the head's rotation included: with the tail's inertia only.
    unsigned int moving_row(const unsigned int node, const unsigned int component) const
    {
      return tail_row(node, component) + tail_numbering_->size();
    }
    unsigned int n_tail_rows() const
    {
      return tail_numbering_ ? (swimmer_.inertia().tail ? 2 : 1) * tail_numbering_->size() : 0;
    }

    const Swimmer<dim>                    &swimmer_;
    FluidDomain<dim>                      *fluid_;
    LinearSystem                          &system_;
    unsigned int                           n_fluid_rows_, rank_, n_ranks_;
    std::unique_ptr<NodeNumbering<dim>>    tail_numbering_;
    MirrorPairs<dim>                       tail_pairs_; ///< when half of the scene is solved
    MotionMap<dim>                         map_;
    Condensation<dim>                      condensation_;
    std::vector<unsigned int>              turning_fluid_nodes_; ///< whose vectors are unknowns of this rank
    unsigned int                           n_turning_tail_nodes_ = 0;
    bool                                   head_turns_           = false;
    std::vector<unsigned int>              tail_cells_;          ///< owned, no images
    unsigned int                           first_tail_cell_ = 0; ///< its number in the condensation
    unsigned int                           first_mass_cell_ = 0;
    std::vector<std::vector<unsigned int>> head_entries_; ///< of pairs of its unknowns, on the rank that has them
    TurningField<dim>                      turning_field_;
    FlowChange                             flow_change_;
  };
} // namespace swimtwin
