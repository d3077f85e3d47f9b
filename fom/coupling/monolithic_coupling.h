// Fluid, tail and head velocities in one system; geometry and linearisation point are iterated.
#pragma once

#include <fom/coupling/acceleration.h>
#include <fom/coupling/coupled_system.h>
#include <fom/coupling/coupling.h>

namespace swimtwin
{
  template <int dim>
  class MonolithicCoupling : public Coupling<dim>
  {
  public:
    /// The swimmer must outlive this.
    MonolithicCoupling(const Swimmer<dim> &swimmer, MPI_Comm communicator);

    void                use_fluid(FluidDomain<dim> *fluid) override;
    StepOutcome         solve(const TimeStep<dim> &step, Configuration<dim> &configuration, Rates<dim> &rates) override;
    std::vector<double> fluid_values() const override;
    unsigned int        n_unknowns() const override { return system_->n_unknowns(); }
    double              flow_change() const override;
    LinearSolverCounts  linear_counts() const override { return solver_.counts(); }
    CouplingState       state() override;
    void                restore(const CouplingState &state) override;

  private:
    using Coupling<dim>::counts_;

    /// How much one iteration reduced the error when last measured, and how large the first correction was then.
    struct Contraction
    {
      double value            = 1.;
      double change           = 0.;
      int    measured_at_step = -1000;
    };

    /// Of a first correction now; 1 when the measurement is too old.
    double              expected_contraction(double change, const TimeStep<dim> &step) const;
    double              linear_tolerance(double slope_weight) const;
    double              wanted_area_rate(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                         const Rates<dim> &rates) const;
    double              iterate_change(const TimeStep<dim> &step) const;
    std::vector<double> predict(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                const Rates<dim> &rates) const;
    Configuration<dim>  advance_kinematics(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                           const CoupledVelocities<dim> &velocities, Rates<dim> &rates) const;

    void accelerate(const TimeStep<dim> &step, const Configuration<dim> &configuration, Configuration<dim> &next,
                    Rates<dim> &rates);

    const Swimmer<dim>                 &swimmer_;
    const Numerics                     &numerics_;
    MPI_Comm                            communicator_;
    LinearSystem                        solver_;
    FluidDomain<dim>                   *fluid_ = nullptr;
    std::unique_ptr<CoupledSystem<dim>> system_;
    std::vector<double>                 unknowns_, unknowns_before_; ///< on the current mesh; empty: unknown
    Contraction                         contraction_;
    double                              area_at_rest_;
    std::unique_ptr<Acceleration>       acceleration_; ///< of the shape, in a steady state
  };
} // namespace swimtwin
