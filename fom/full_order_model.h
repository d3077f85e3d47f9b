// The full-order swimmer in time: BDF2, monolithic coupling iterated to convergence, remeshing by quality.
#pragma once

#include <datasets/trajectory.h>
#include <fom/bdf2.h>
#include <fom/coupled_system.h>

#include <memory>
#include <optional>
#include <string>

namespace swimtwin
{
  /// An accepted instant with what the next step needs.
  template <int dim>
  struct Instant
  {
    double             time_s = 0.;
    Configuration<dim> configuration;
    Rates<dim>         rates;
  };

  struct StepCounts
  {
    int    n_steps = 0, n_coupling_iterations = 0, n_remeshes = 0, n_step_halvings = 0;
    double mesh_motion_cpu_s = 0., remeshing_cpu_s = 0., coupling_cpu_s = 0.;
  };

  /// The state from which a run goes on as if it had not stopped.
  template <int dim>
  struct ModelState
  {
    Instant<dim>                        now, before;
    double                              time_step_before_s = 0.; ///< 0: nothing before
    int                                 grid_step = 0, steps_since_remeshing = 0;
    std::vector<double>                 unknowns, unknowns_before;
    std::optional<FluidMeshRecord<dim>> fluid_mesh;
    RigidPose<dim>                      pose_at_meshing;
    bool                                remesh_is_due                = false;
    double                              contraction_value            = 1.;
    int                                 contraction_measured_at_step = -1000;
    StepCounts                          counts;
    LinearSolverCounts                  linear_counts;
  };

  template <int dim>
  class FullOrderModel
  {
  public:
    /// Meshes the scene at rest. The scene must outlive the model. Collective; throws ComputationError.
    FullOrderModel(const Scene &scene, MPI_Comm communicator);

    /// Advance by one step of the scene's time grid, with smaller ones inside where they are needed: at the start, and
    /// after failures. Collective; throws ComputationError that names time, cause and remedy.
    void advance();

    const Instant<dim> &now() const { return now_; }
    int                 coupling_iterations_of_last_step() const { return iterations_of_last_step_; }
    /// Whether the last advance() made a new mesh.
    bool                    just_remeshed() const { return just_remeshed_; }
    const StepCounts       &counts() const { return counts_; }
    LinearSolverCounts      linear_counts() const { return linear_system_.counts(); }
    unsigned int            n_unknowns() const { return system_->n_unknowns(); }
    const Swimmer<dim>     &swimmer() const { return swimmer_; }
    const FluidDomain<dim> *fluid() const { return fluid_.get(); }
    /// Balance of the last accepted step (before any remeshing after it).
    const PowerBalance &balance() const { return balance_; }
    /// Fluid rows' values (velocities, scaled pressures) of the last accepted step, on its mesh; empty before
    /// the first and without fluid.
    std::vector<double> fluid_values() const;

    /// Collective. The next step factorises anew, so that a restored run repeats this one's arithmetic.
    ModelState<dim> state();
    void            restore(const ModelState<dim> &state);

  private:
    enum class Outcome { accepted, mesh_inverted, tail_inverted, coupling_diverged, linear_solver_failed };
    static std::string cause(Outcome outcome);

    /// How much one coupling iteration reduces the error, as last measured; 1 when that was too long ago.
    struct Contraction
    {
      double value            = 1.;
      int    measured_at_step = -1000;
      double expected(int step) const;
    };

    Outcome             try_step(double dt);
    void                accept(double dt, Configuration<dim> configuration, Rates<dim> rates);
    Configuration<dim>  advance_kinematics(const Configuration<dim> &known, double slope_weight,
                                           const CoupledVelocities<dim> &velocities, Rates<dim> &rates) const;
    Configuration<dim>  known_part(const Bdf2 &bdf) const;
    Rates<dim>          extrapolated_rates(double dt) const;
    std::vector<double> extrapolated_unknowns(double dt, const Configuration<dim> &configuration,
                                              const Rates<dim> &rates) const;
    bool                wants_remeshing() const;
    void                remesh();
    void                use_fluid_mesh(FluidMesh<dim> mesh, const RigidPose<dim> &pose);
    void                solve_initial_flow();

    const Scene                        &scene_;
    MPI_Comm                            communicator_;
    Swimmer<dim>                        swimmer_;
    LinearSystem                        linear_system_;
    std::unique_ptr<FluidDomain<dim>>   fluid_;
    std::unique_ptr<CoupledSystem<dim>> system_;

    Instant<dim>        now_, before_;
    double              time_step_before_ = 0.; ///< 0: nothing before
    int                 grid_step_        = 0;
    std::vector<double> unknowns_, unknowns_before_; ///< of now and before, on the current mesh; empty: unknown
    PowerBalance        balance_;
    Contraction         contraction_;
    StepCounts          counts_;
    int                 iterations_of_last_step_ = 0, steps_since_remeshing_ = 0;
    bool                just_remeshed_ = false, remesh_is_due_ = false;
  };
} // namespace swimtwin
