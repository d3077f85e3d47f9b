#include <fom/coupling/fixed_point_coupling.h>

#include <datasets/scene/mirror_plane.h>
#include <fom/elastic/nodal_vector.h>

#include <fom/algebra/cpu_time.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// The tail's Newton method is to leave nothing that the coupling could notice.
    constexpr double tail_tolerance_share = 1e-2;

    /// By factors, whatever their size, unless iterations are asked for: it has two matrices, and uses each once.
    LinearSolverOptions options_of_flow(const Numerics &numerics, const int dimension)
    {
      LinearSolverOptions options = solver_options(numerics, dimension);
      if (options.method == LinearSolver::automatic)
        options.method = LinearSolver::direct;
      return options;
    }

    LinearSolverOptions options_of_tail(const Numerics &numerics, const int dimension)
    {
      LinearSolverOptions options = options_of_flow(numerics, dimension);
      options.standard            = StandardPreconditioner::subdomains;
      return options;
    }
  } // namespace

  template <int dim>
  FixedPointCoupling<dim>::FixedPointCoupling(const Swimmer<dim> &swimmer, const MPI_Comm communicator)
      : swimmer_(swimmer), numerics_(swimmer.scene().numerics), communicator_(communicator),
        flow_solver_(communicator, options_of_flow(numerics_, dim)),
        tail_(swimmer, options_of_tail(numerics_, dim), communicator), acceleration_(make_acceleration(numerics_))
  {
  }

  template <int dim>
  void FixedPointCoupling<dim>::use_fluid(FluidDomain<dim> *fluid)
  {
    fluid_ = fluid;
    flow_  = std::make_unique<FluidRigidSystem<dim>>(swimmer_, *fluid, flow_solver_, swimmer_.scene().head.is_free(),
                                                    communicator_, moves_in_plane(swimmer_.scene()));
    unknowns_.clear();
    unknowns_before_.clear();
    fluid_values_.clear();
  }

  template <int dim>
  bool FixedPointCoupling<dim>::solve_flow(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                           Rates<dim> &rates, std::vector<double> &unknowns)
  {
    flow_->assemble(configuration, rates.shape_rate, step.time_s);

    // The tail's internal forces do no work in a rigid motion; its dead loads do.
    const auto [torque, derivative, axis] = swimmer_.torque_on_head(configuration.pose, step.time_s);
    const TurningField<dim> field{derivative * step.slope_weight, axis};
    Tensor<1, dim>          force  = swimmer_.force_on_head(step.time_s);
    AngularVelocity<dim>    moment = torque - field.torque_by_rate * rates.omega;
    const auto              x      = swimmer_.tail_positions(configuration);
    for (unsigned int a = 0; a < x.size(); ++a)
    {
      const Tensor<1, dim> f = swimmer_.load_on_tail_node(a, step.time_s);
      force += f;
      moment += torque_of_force<dim>(x[a] - configuration.pose.center, f);
    }
    Tensor<1, n_rigid<dim>> load;
    for (int k = 0; k < n_rigid<dim>; ++k)
      load[k] = k < dim ? force[k] : moment[k - dim];
    flow_->add_load(load);
    flow_->add_torque_by_rotation(field);
    if (!flow_->solve(unknowns))
      return false;
    const auto velocity = flow_->rigid_velocity(unknowns);
    for (int c = 0; c < dim; ++c)
      rates.velocity[c] = velocity[c];
    for (int k = 0; k < n_rotations<dim>; ++k)
      rates.omega[k] = velocity[dim + k];
    return true;
  }

  template <int dim>
  NodalField<dim> FixedPointCoupling<dim>::loads_on_tail(const Configuration<dim> &configuration, const double time_s,
                                                         const std::vector<double> &fluid_values) const
  {
    const std::vector<double> on_fluid = fluid_->force_on_fluid_at_surface(fluid_values);
    const Tensor<2, dim>      Rt       = transpose(configuration.pose.rotation());
    NodalField<dim>           loads(swimmer_.tail().mesh.n_nodes());
    for (unsigned int a = 0; a < loads.size(); ++a)
      loads[a] = swimmer_.load_on_tail_node(a, time_s);
    for (unsigned int k = 0; k < swimmer_.n_surface_nodes(); ++k)
      if (const int node = swimmer_.tail_node(k); node >= 0)
        for (int c = 0; c < dim; ++c)
          loads[node][c] -= on_fluid[fluid_->surface_row(k, c)];
    for (auto &load : loads)
      load = Rt * load;
    return loads;
  }

  template <int dim>
  StepOutcome FixedPointCoupling<dim>::solve(const TimeStep<dim> &step, Configuration<dim> &configuration,
                                             Rates<dim> &rates)
  {
    // The fluid's load, and with it S' and the inverse of a good relaxation, are inversely proportional to the step.
    if (std::abs(step.slope_weight / slope_weight_ - 1.) > 1e-6)
      acceleration_->forget(numerics_.relaxation * step.slope_weight / swimmer_.scene().time.time_step_s());
    else
      acceleration_->start();
    slope_weight_                = step.slope_weight;
    std::vector<double> unknowns = unknowns_.empty() ? std::vector<double>(flow_->n_unknowns(), 0.)
                                                     : extrapolate(unknowns_, unknowns_before_, step.growth);
    const double        tail_tolerance_m =
        tail_tolerance_share * numerics_.coupling_tolerance * swimmer_.scene().body_length_m();

    for (int iteration = 1; iteration <= numerics_.max_coupling_iterations; ++iteration)
    {
      {
        const ScopedCpuTime time(counts_.mesh_motion_cpu_s);
        if (const auto outcome = move_meshes<dim>(fluid_, swimmer_, configuration); outcome != StepOutcome::accepted)
          return outcome;
      }
      const ScopedCpuTime time(counts_.iteration_cpu_s);
      ++counts_.n_iterations;
      for (unsigned int a = 0; a < configuration.shape.size(); ++a)
        rates.shape_rate[a] = (configuration.shape[a] - step.known.shape[a]) / step.slope_weight;
      if (!solve_flow(step, configuration, rates, unknowns))
        return StepOutcome::linear_solver_failed;
      if (flow_->field_outruns_step())
        return StepOutcome::unstable_equilibrium;
      std::vector<double> values = flow_->fluid_values(unknowns);

      Configuration<dim> image = configuration;
      image.pose.set_attitude(step.known.pose);
      image.pose.turn(step.slope_weight * rates.omega);
      image.pose.center = head_center(swimmer_, step, image, rates);
      {
        const ScopedCpuTime tail_time(counts_.tail_cpu_s);
        if (!tail_.solve(loads_on_tail(configuration, step.time_s, values), tail_tolerance_m, image.shape))
          return StepOutcome::tail_equilibrium_failed;
      }
      const double residual = swimmer_.relative_change(image, configuration);
      if (!(residual < far_too_far))
        return StepOutcome::coupling_diverged;
      configuration.pose = image.pose;
      if (residual <= numerics_.coupling_tolerance)
      {
        unknowns_before_ = std::move(unknowns_);
        unknowns_        = std::move(unknowns);
        fluid_values_    = std::move(values);
        return StepOutcome::accepted;
      }
      configuration.shape =
          nodal_field<dim>(acceleration_->next(vector_of<dim>(configuration.shape), vector_of<dim>(image.shape)));
    }
    return StepOutcome::coupling_diverged;
  }

  template <int dim>
  CouplingState FixedPointCoupling<dim>::state()
  {
    flow_solver_.forget_factors();
    tail_.forget_factors();
    slope_weight_ = 0.; // makes the acceleration forget
    CouplingState state;
    state.unknowns           = unknowns_;
    state.unknowns_before    = unknowns_before_;
    state.counts             = counts_;
    state.linear_counts      = flow_solver_.counts();
    state.tail_linear_counts = tail_.counts();
    return state;
  }

  template <int dim>
  void FixedPointCoupling<dim>::restore(const CouplingState &state)
  {
    unknowns_        = state.unknowns;
    unknowns_before_ = state.unknowns_before;
    counts_          = state.counts;
    flow_solver_.set_counts(state.linear_counts);
    tail_.set_counts(state.tail_linear_counts);
  }

  template class FixedPointCoupling<2>;
  template class FixedPointCoupling<3>;
} // namespace swimtwin
