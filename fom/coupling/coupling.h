// How fluid, tail and head are solved together in one time step: what all couplings have in common.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  enum class StepOutcome {
    accepted,
    mesh_inverted,
    mesh_motion_failed,
    tail_inverted,
    coupling_diverged,
    linear_solver_failed,
    unstable_equilibrium,
    tail_equilibrium_failed
  };

  /// One clause each for a message: what went wrong, and what the user can do about it.
  std::string cause(StepOutcome outcome);
  std::string remedy(StepOutcome outcome, const Scene &scene);
  std::string shorter_steps(const Scene &scene); ///< what to change to have them

  /// One implicit step of a two-step formula: what is advanced = known + slope_weight * its rate, both at its end.
  /// Advanced are the angle, the shape and the middle of the body, from which the head's centre follows, and, with
  /// inertia, velocities.
  template <int dim>
  struct TimeStep
  {
    Configuration<dim> known;        ///< its centre is the middle's
    double             slope_weight; ///< s; 0: the configuration is given, only the rates are looked for
    double             time_s;       ///< at its end
    double             growth;       ///< its length over that of the step before; 0: nothing before
    int                number;       ///< of steps before it
    std::optional<BodyVelocities<dim>> known_velocities = {}; ///< of a body with inertia: the same formula for them
  };

  /// Centre of the head of a configuration whose angle and shape are at the end of the step, like the rates.
  template <int dim>
  dealii::Point<dim> head_center(const Swimmer<dim> &swimmer, const TimeStep<dim> &step,
                                 const Configuration<dim> &configuration, const Rates<dim> &rates);

  struct CouplingCounts
  {
    int    n_iterations      = 0;
    double mesh_motion_cpu_s = 0., iteration_cpu_s = 0.; ///< s; iterations without mesh motion
    double tail_cpu_s = 0.; ///< of the iterations, the part of a partitioned coupling's tail
  };

  /// What a coupling has to remember to go on as if it had not stopped.
  struct CouplingState
  {
    std::vector<double> unknowns, unknowns_before;
    double              contraction = 1., contraction_change = 0.;
    int                 contraction_measured_at_step = -1000;
    CouplingCounts      counts;
    LinearSolverCounts  linear_counts, tail_linear_counts;
  };

  /// A coupling iteration that moves the body by so many body lengths has diverged.
  constexpr double far_too_far = 10.;

  template <int dim>
  class Coupling
  {
  public:
    virtual ~Coupling() = default;

    /// A new mesh (or none: a tail in vacuum); everything about the old one is dropped. Collective.
    virtual void use_fluid(FluidDomain<dim> *fluid) = 0;

    /// Solve one step. `configuration` and `rates` hold the prediction, then the solution. Collective.
    virtual StepOutcome solve(const TimeStep<dim> &step, Configuration<dim> &configuration, Rates<dim> &rates) = 0;

    /// Fluid rows' values (velocities, scaled pressures) of the last accepted step; empty before the first on this
    /// mesh, and without fluid.
    virtual std::vector<double> fluid_values() const = 0;
    virtual unsigned int        n_unknowns() const   = 0;
    /// Of the flow over the last accepted step, relative to it; zero at rest.
    virtual double flow_change() const { return 0.; }
    /// Of the system that holds the fluid, and of a partitioned coupling's tail.
    virtual LinearSolverCounts linear_counts() const = 0;
    virtual LinearSolverCounts tail_linear_counts() const { return {}; }
    const CouplingCounts      &counts() const { return counts_; }

    /// The next step starts without factors and accelerations, so that a restored run repeats this one's arithmetic.
    virtual CouplingState state()                             = 0;
    virtual void          restore(const CouplingState &state) = 0;

  protected:
    CouplingCounts counts_;
  };

  /// Let the meshes of fluid, if there is one, and tail follow a configuration: accepted, or what went wrong.
  template <int dim>
  StepOutcome move_meshes(FluidDomain<dim> *fluid, const Swimmer<dim> &swimmer,
                          const Configuration<dim> &configuration);

  /// The coupling that a scene asks for; monolithic if there is nothing to partition. Collective.
  template <int dim>
  std::unique_ptr<Coupling<dim>> make_coupling(const Swimmer<dim> &swimmer, MPI_Comm communicator);

  LinearSolverOptions solver_options(const Numerics &numerics, int dimension);

  /// Two steps' solutions extrapolated linearly to the next; the last one if there is no other.
  std::vector<double> extrapolate(const std::vector<double> &now, const std::vector<double> &before, double growth);
} // namespace swimtwin
