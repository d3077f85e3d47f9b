// The full-order swimmer in time: BDF2, a coupling iterated to convergence in every step, remeshing by quality.
#pragma once

#include <fom/coupling/coupling.h>
#include <fom/step/start_work.h>

#include <memory>
#include <optional>

namespace swimtwin
{
  struct StepCounts
  {
    int    n_steps = 0, n_remeshes = 0, n_step_halvings = 0;
    double remeshing_cpu_s = 0.;
  };

  /// The state from which a run goes on as if it had not stopped.
  template <int dim>
  struct ModelState
  {
    Instant<dim>                        now, before;
    double                              time_step_before_s = 0.; ///< 0: nothing before
    int                                 grid_step = 0, steps_since_remeshing = 0;
    std::optional<FluidMeshRecord<dim>> fluid_mesh;
    RigidPose<dim>                      pose_at_meshing;
    bool                                remesh_is_due = false;
    StepCounts                          counts;
    CouplingState                       coupling;
    std::optional<PowerBalance>         balance;    ///< where works are still integrated along the way
    FluidPast<dim>                      fluid_past; ///< empty without the fluid's inertia
  };

  template <int dim>
  class FullOrderModel
  {
  public:
    /// Meshes the scene at rest. The scene must outlive the model. Collective; throws ComputationError, and InputError
    /// if the scene's mesh size does not do at rest.
    FullOrderModel(const Scene &scene, MPI_Comm communicator);
    /// The same on meshes of body and fluid at rest that are there already. Where it needs another mesh of the fluid,
    /// it makes the scene's.
    FullOrderModel(const Scene &scene, BodyMesh<dim> body, FluidMesh<dim> fluid, MPI_Comm communicator);

    /// Advance by one step of the scene's time grid, with smaller ones inside where they are needed: at the start, and
    /// after failures. Collective; throws ComputationError that names time, cause and remedy.
    void advance();

    const Instant<dim> &now() const { return now_; }
    int                 coupling_iterations_of_last_step() const { return iterations_of_last_step_; }
    /// Whether the last advance() made a new mesh.
    bool                    just_remeshed() const { return just_remeshed_; }
    const StepCounts       &counts() const { return counts_; }
    const Coupling<dim>    &coupling() const { return *coupling_; }
    unsigned int            n_unknowns() const { return coupling_->n_unknowns(); }
    const Swimmer<dim>     &swimmer() const { return swimmer_; }
    const FluidDomain<dim> *fluid() const { return fluid_.get(); }
    /// Balance of the last accepted step (before any remeshing after it).
    const PowerBalance &balance() const { return balance_; }
    /// Work of the last advance(), where powers do not tell it: in the first steps of a start under load.
    const std::optional<IntervalWork> &work_of_last_step() const { return work_; }
    /// Collective. The next step factorises anew, so that a restored run repeats this one's arithmetic.
    ModelState<dim> state();
    void            restore(const ModelState<dim> &state);

  private:
    void              start_at_rest();
    StepOutcome       try_step(double dt);
    int               next_ticks(int done, int largest) const;
    [[noreturn]] void give_up(StepOutcome outcome, int halvings) const;
    void              accept(double dt, const TimeStep<dim> &step, Configuration<dim> configuration, Rates<dim> rates);
    void              advance_in_time();
    void              advance_to_steady_state();
    bool              wants_remeshing() const;
    void              mesh_at_start(); ///< throws InputError where a given shape cannot be meshed
    bool              remesh();        ///< false if it failed for the place (mesh_around.h); the old mesh then stays
    void              use_fluid(std::unique_ptr<FluidDomain<dim>> fluid);
    void              solve_initial_flow();
    PowerBalance      compute_balance(const std::optional<BodyVelocities<dim>> &acceleration = {}) const;

    const Scene                      &scene_;
    MPI_Comm                          communicator_;
    Swimmer<dim>                      swimmer_;
    std::unique_ptr<FluidDomain<dim>> fluid_;
    std::unique_ptr<Coupling<dim>>    coupling_;

    Instant<dim>                now_, before_;
    double                      time_step_before_ = 0.; ///< 0: nothing before
    int                         grid_step_        = 0;
    PowerBalance                balance_;
    std::string                 why_no_mesh_; ///< of the last remesh()
    bool                        follows_way_; ///< works are integrated along the way, after a start under load
    std::optional<IntervalWork> work_;
    StepCounts                  counts_;
    int                         iterations_of_last_step_ = 0, steps_since_remeshing_ = 0;
    bool                        just_remeshed_ = false, remesh_is_due_ = false;
  };
} // namespace swimtwin
