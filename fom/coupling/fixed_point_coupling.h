// Fluid with rigid motion and elastic tail solved in turn: the partitioned scheme of the reference study.
#pragma once

#include <fom/body/tail_equilibrium.h>
#include <fom/coupling/acceleration.h>
#include <fom/coupling/coupling.h>
#include <fom/resistance/fluid_rigid_system.h>

namespace swimtwin
{
  /// Algorithm 1 of arXiv 2511.02402, on the meshes, spaces and motion map of the monolithic coupling. Each iteration:
  /// mesh map to the present displacement; fluid-rigid problem, the shape rate given; total displacement from the new
  /// rigid motion; fluid-elastic problem, the tail under the fluid's reaction; relaxation of the shape. It ends when an
  /// iteration's residual (change of the configuration, root mean square over the tail, in body lengths) is below the
  /// coupling tolerance.
  template <int dim>
  class FixedPointCoupling : public Coupling<dim>
  {
  public:
    /// The swimmer has a tail, the scene a fluid, not closed by walls. The swimmer must outlive this. Collective.
    FixedPointCoupling(const Swimmer<dim> &swimmer, MPI_Comm communicator);

    void                use_fluid(FluidDomain<dim> *fluid) override;
    StepOutcome         solve(const TimeStep<dim> &step, Configuration<dim> &configuration, Rates<dim> &rates) override;
    std::vector<double> fluid_values() const override { return fluid_values_; }
    unsigned int        n_unknowns() const override { return flow_->n_unknowns() + tail_.n_unknowns(); }
    LinearSolverCounts  linear_counts() const override { return flow_solver_.counts(); }
    LinearSolverCounts  tail_linear_counts() const override { return tail_.counts(); }
    CouplingState       state() override;
    void                restore(const CouplingState &state) override;

  private:
    using Coupling<dim>::counts_;

    bool            solve_flow(const TimeStep<dim> &step, const Configuration<dim> &configuration, Rates<dim> &rates,
                               std::vector<double> &unknowns);
    NodalField<dim> loads_on_tail(const Configuration<dim> &configuration, double time_s,
                                  const std::vector<double> &fluid_values) const;

    const Swimmer<dim>                    &swimmer_;
    const Numerics                        &numerics_;
    MPI_Comm                               communicator_;
    LinearSystem                           flow_solver_;
    TailEquilibrium<dim>                   tail_;
    std::unique_ptr<Acceleration>          acceleration_;
    FluidDomain<dim>                      *fluid_ = nullptr;
    std::unique_ptr<FluidRigidSystem<dim>> flow_;
    double                                 slope_weight_ = 0.; ///< of the step the acceleration has learnt from
    std::vector<double>                    unknowns_, unknowns_before_, fluid_values_;
  };
} // namespace swimtwin
