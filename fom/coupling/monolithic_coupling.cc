#include <fom/coupling/monolithic_coupling.h>

#include <datasets/system/error.h>
#include <fom/algebra/cpu_time.h>
#include <fom/elastic/nodal_vector.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// An angular velocity that belongs to the attitude `solved`, at the end of a step from the attitude `known`: as
    /// far as that turns the body, omega goes along, and exp(c omega) turns nothing that is along omega.
    AngularVelocity<2> with_body(const AngularVelocity<2> &omega, const Attitude<2> &, const Attitude<2> &)
    {
      return omega;
    }
    AngularVelocity<3> with_body(const AngularVelocity<3> &omega, const Attitude<3> &known, const Attitude<3> &solved)
    {
      return known.rotation() * (transpose(solved.rotation()) * omega);
    }
  } // namespace

  template <int dim>
  MonolithicCoupling<dim>::MonolithicCoupling(const Swimmer<dim> &swimmer, const MPI_Comm communicator)
      : swimmer_(swimmer), numerics_(swimmer.scene().numerics), communicator_(communicator),
        solver_(communicator, solver_options(numerics_, dim)),
        area_at_rest_(swimmer.volume(swimmer.configuration_at_rest()))
  {
    // The flow depends on the shape: in a time step weakly, in a steady state as strongly as it likes.
    if (swimmer.scene().time.is_steady && swimmer.scene().fluid && swimmer.can_bend())
      acceleration_ = std::make_unique<QuasiNewtonLeastSquares>(0);
  }

  template <int dim>
  void MonolithicCoupling<dim>::use_fluid(FluidDomain<dim> *fluid)
  {
    fluid_  = fluid;
    system_ = std::make_unique<CoupledSystem<dim>>(swimmer_, fluid, solver_, communicator_);
    unknowns_.clear();
    unknowns_before_.clear();
  }

  template <int dim>
  double MonolithicCoupling<dim>::linear_tolerance(const double slope_weight) const
  {
    // An error of the velocities by a share e is one of elastic stress by e c (lambda + 2 mu_s) / mu times the viscous
    // stress: it must stay small against it, however stiff the tail. Below round-off there is nothing to gain.
    constexpr double harmless = 1e3, round_off = 1e-13;
    const Scene     &scene = swimmer_.scene();
    if (!scene.fluid || !swimmer_.can_bend())
      return numerics_.linear_tolerance;
    const LameConstants lame      = lame_constants(scene.tail->young_modulus_Pa, scene.tail->poisson_ratio);
    const double        stiffness = slope_weight * (lame.lambda_Pa + 2. * lame.mu_Pa) / scene.fluid->viscosity_Pa_s;
    return std::clamp(numerics_.linear_tolerance * harmless / std::max(stiffness, harmless),
                      std::min(round_off, numerics_.linear_tolerance), numerics_.linear_tolerance);
  }

  template <int dim>
  double MonolithicCoupling<dim>::wanted_area_rate(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                                   const Rates<dim> &rates) const
  {
    // A closed fluid keeps the body's area. Its rate alone would not: what a step adds, second order in its length,
    // stays for ever, because the pressure's level carries any load.
    const Scene &scene = swimmer_.scene();
    if (!scene.fluid || !swimmer_.can_bend() || scene.domain->has_traction_free_wall())
      return 0.;
    return swimmer_.volume_rate(configuration, rates) -
           (swimmer_.volume(configuration) - area_at_rest_) / step.slope_weight;
  }

  template <int dim>
  std::vector<double> MonolithicCoupling<dim>::predict(const TimeStep<dim>      &step,
                                                       const Configuration<dim> &configuration,
                                                       const Rates<dim>         &rates) const
  {
    if (unknowns_.empty())
    {
      CoupledVelocities<dim> velocities{rates.velocity, rates.omega, {}};
      for (const auto &shape_rate : rates.shape_rate)
        velocities.tail.push_back(rates.velocity + configuration.pose.rotation() * shape_rate);
      return system_->guess(velocities);
    }
    return extrapolate(unknowns_, unknowns_before_, step.growth);
  }

  template <int dim>
  Configuration<dim>
  MonolithicCoupling<dim>::advance_kinematics(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                              const CoupledVelocities<dim> &velocities, Rates<dim> &rates) const
  {
    const auto        &known = step.known;
    const double       slope = step.slope_weight;
    Configuration<dim> next;
    // The velocities belong to the geometry they were solved on, w = U + omega x R (X + d) + R d' with its R and d, and
    // turn with the body: where no wall is near, a correction of the angle then leaves nothing to iterate. The tail's
    // leave out omega x R (X + d).
    const Tensor<2, dim> Rt = transpose(configuration.pose.rotation());
    rates.omega             = with_body(velocities.head_omega, known.pose, configuration.pose);
    next.pose.set_attitude(known.pose);
    next.pose.turn(slope * rates.omega);
    rates.velocity = next.pose.rotation() * (Rt * velocities.head_velocity);
    if (!swimmer_.has_tail())
    {
      next.pose.center = head_center(swimmer_, step, next, rates);
      return next;
    }

    const auto &mesh           = swimmer_.tail().mesh;
    const bool  shape_is_given = swimmer_.scene().tail->is_driven();
    next.shape.resize(mesh.n_nodes());
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      if (!swimmer_.is_clamped(a) || shape_is_given)
        next.shape[a] = known.shape[a] + slope * (Rt * (velocities.tail[a] - velocities.head_velocity));
    if (numerics_.tail_order == 1)
      for (unsigned int e = 0; e < mesh.edges().size(); ++e)
        next.shape[mesh.n_vertices() + e] = .5 * (next.shape[mesh.edges()[e][0]] + next.shape[mesh.edges()[e][1]]);
    rates.shape_rate.resize(mesh.n_nodes());
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      rates.shape_rate[a] = (next.shape[a] - known.shape[a]) / slope;
    next.pose.center = head_center(swimmer_, step, next, rates);
    return next;
  }

  template <int dim>
  double MonolithicCoupling<dim>::iterate_change(const TimeStep<dim> &step) const
  {
    // Where convection iterates on the flow: by how much this moves a body that goes with it, in body lengths, or, in
    // long steps, the share of the flow.
    const auto &[change, size] = system_->flow_change();
    return change == 0. ? 0. : change * std::min(step.slope_weight / swimmer_.scene().body_length_m(), 1. / size);
  }

  template <int dim>
  void MonolithicCoupling<dim>::accelerate(const TimeStep<dim> &step, const Configuration<dim> &configuration,
                                           Configuration<dim> &next, Rates<dim> &rates)
  {
    next.shape = nodal_field<dim>(acceleration_->next(vector_of<dim>(configuration.shape), vector_of<dim>(next.shape)));
    for (unsigned int a = 0; a < next.shape.size(); ++a)
      rates.shape_rate[a] = (next.shape[a] - step.known.shape[a]) / step.slope_weight;
  }

  template <int dim>
  StepOutcome MonolithicCoupling<dim>::solve(const TimeStep<dim> &step, Configuration<dim> &configuration,
                                             Rates<dim> &rates)
  {
    solver_.aim_at(linear_tolerance(step.slope_weight));
    if (acceleration_)
      acceleration_->forget(1.);
    std::vector<double> unknowns      = predict(step, configuration, rates);
    double              change_before = 0., contraction_before = 0.;
    for (int iteration = 1; iteration <= numerics_.max_coupling_iterations; ++iteration)
    {
      {
        const ScopedCpuTime time(counts_.mesh_motion_cpu_s);
        if (const auto outcome = move_meshes<dim>(fluid_, swimmer_, configuration); outcome != StepOutcome::accepted)
          return outcome;
      }
      const ScopedCpuTime time(counts_.iteration_cpu_s);
      ++counts_.n_iterations;
      const double area_rate = wanted_area_rate(step, configuration, rates);
      const auto  *known     = step.known_velocities ? &*step.known_velocities : nullptr;
      if (!system_->solve({configuration, rates, step.slope_weight, step.time_s, area_rate, known}, unknowns))
        return StepOutcome::linear_solver_failed;
      if (system_->field_outruns_step())
        return StepOutcome::unstable_equilibrium;
      Configuration<dim> next   = advance_kinematics(step, configuration, system_->velocities(unknowns), rates);
      const double       change = std::max(swimmer_.relative_change(next, configuration), iterate_change(step));
      if (acceleration_)
        accelerate(step, configuration, next, rates);
      configuration = std::move(next);
      if (iteration == 2)
        contraction_ = {change / change_before, change_before, step.number};
      if (!(change < far_too_far))
        return StepOutcome::coupling_diverged;
      // What is left to correct is estimated from the iteration's contraction: measured in this step, or, for the first
      // iteration, in a recent one. In vacuum the worse of the last two: a thin tail far from its equilibrium is bent
      // and stretched in turn, and a small change comes between two large ones. A fluid damps that.
      const double contraction = iteration == 1 ? expected_contraction(change, step) : change / change_before;
      const double left_over   = acceleration_ ? change : std::max(contraction, contraction_before) * change;
      contraction_before       = fluid_ || iteration == 1 ? 0. : contraction;
      if (left_over <= numerics_.coupling_tolerance)
      {
        if (swimmer_.has_tail() && swimmer_.elasticity().is_inverted(configuration.shape))
          return StepOutcome::tail_inverted;
        unknowns_before_ = std::move(unknowns_);
        unknowns_        = std::move(unknowns);
        return StepOutcome::accepted;
      }
      change_before = change;
    }
    return StepOutcome::coupling_diverged;
  }

  template <int dim>
  double MonolithicCoupling<dim>::flow_change() const
  {
    if (!fluid_ || unknowns_.empty())
      return 0.;
    const auto   now  = system_->expand(unknowns_);
    const double size = fluid_->distance(now);
    if (unknowns_before_.empty())
      return size > 0. ? 1. : 0.;
    return size > 0. ? fluid_->distance(now, system_->expand(unknowns_before_)) / size : 0.;
  }

  template <int dim>
  double MonolithicCoupling<dim>::expected_contraction(const double change, const TimeStep<dim> &step) const
  {
    // Partly Picard's iteration, partly Newton's, whose contraction grows with the correction. With inertia it grows
    // with the step, too, by how much nobody knows: what a shorter one measured does not count.
    if (!fluid_ && !swimmer_.inertia().any()) // nothing damps the tail, whose next change may be of another kind
      return 1.;
    constexpr int    valid_for_steps = 10;
    constexpr double safety          = 3.;
    const auto      &measured        = contraction_;
    const bool       is_known =
        step.number - measured.measured_at_step <= valid_for_steps && (step.growth <= 1. || !swimmer_.inertia().any());
    return is_known ? safety * measured.value * std::max(1., change / measured.change) : 1.;
  }

  template <int dim>
  std::vector<double> MonolithicCoupling<dim>::fluid_values() const
  {
    if (!fluid_ || unknowns_.empty())
      return {};
    std::vector<double> rows = system_->expand(unknowns_);
    rows.resize(fluid_->n_rows()); // the tail's and the head's follow
    return rows;
  }

  template <int dim>
  CouplingState MonolithicCoupling<dim>::state()
  {
    solver_.forget_factors();
    return {unknowns_,
            unknowns_before_,
            contraction_.value,
            contraction_.change,
            contraction_.measured_at_step,
            counts_,
            solver_.counts(),
            {}};
  }

  template <int dim>
  void MonolithicCoupling<dim>::restore(const CouplingState &state)
  {
    if (!state.unknowns.empty() && state.unknowns.size() != n_unknowns())
      throw InputError(
          "the checkpoint has other unknowns than this version gives the scene: start afresh with --force");
    unknowns_        = state.unknowns;
    unknowns_before_ = state.unknowns_before;
    contraction_     = {state.contraction, state.contraction_change, state.contraction_measured_at_step};
    counts_          = state.counts;
    solver_.set_counts(state.linear_counts);
  }

  template class MonolithicCoupling<2>;
  template class MonolithicCoupling<3>;
} // namespace swimtwin
