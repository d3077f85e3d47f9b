#include <fom/full_order_model.h>

#include <datasets/error.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// One step of the time grid is divided into so many ticks; smaller steps are whole powers of two of them.
    constexpr int ticks_per_step = 1024;
    /// The run starts with an eighth of a step, by backward Euler, then doubles: the start's error is a 64th.
    constexpr int ticks_of_first_step = ticks_per_step / 8;

    /// A coupling iteration that moves the body by so many body lengths has diverged.
    constexpr double far_too_far = 10.;

    double cpu_seconds()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    LinearSolverOptions solver_options(const Numerics &numerics)
    {
      LinearSolverOptions options;
      options.tolerance           = numerics.linear_tolerance;
      options.reuse_factorization = numerics.reuse_factorization;
      return options;
    }
  } // namespace

  template <int dim>
  FullOrderModel<dim>::FullOrderModel(const Scene &scene, const MPI_Comm communicator)
      : scene_(scene), communicator_(communicator), swimmer_(scene, communicator),
        linear_system_(communicator, solver_options(scene.numerics))
  {
    now_.configuration = swimmer_.configuration_at_rest();
    now_.rates.shape_rate.resize(now_.configuration.shape.size());
    if (scene.fluid)
    {
      remesh();
      counts_.n_remeshes = 0; // the first mesh is not a remeshing
    }
    else
      system_ = std::make_unique<CoupledSystem<dim>>(swimmer_, nullptr, linear_system_, communicator_);
    if (!swimmer_.has_tail())
      solve_initial_flow();
  }

  template <int dim>
  void FullOrderModel<dim>::solve_initial_flow()
  {
    // Without a tail the velocities follow from the position alone; with one, the run starts from rest.
    unknowns_.assign(system_->n_unknowns(), 0.);
    if (!system_->solve({now_.configuration, now_.rates, 0., 0.}, unknowns_))
      throw ComputationError("the flow at the start could not be solved: refine [numerics] mesh_size_m");
    const auto velocities = system_->velocities(unknowns_);
    now_.rates            = {velocities.head_velocity, velocities.head_omega, {}};
    balance_              = system_->balance(now_.configuration, now_.rates, unknowns_, 0.);
  }

  template <int dim>
  void FullOrderModel<dim>::advance()
  {
    iterations_of_last_step_ = 0;
    just_remeshed_           = false;
    const double tick        = scene_.time.time_step_s() / ticks_per_step;
    bool         fresh_mesh  = steps_since_remeshing_ == 0;
    int          largest = time_step_before_ == 0. ? ticks_of_first_step : ticks_per_step, halvings = 0;
    for (int done = 0; done < ticks_per_step;)
    {
      // A new mesh is made just before it is needed, so that the fields of every instant can still be read.
      if (remesh_is_due_)
      {
        remesh();
        fresh_mesh = just_remeshed_ = true;
      }
      // The largest power of two that fits the grid, is allowed, and at most doubles the last step.
      int ticks = std::min(largest, ticks_per_step);
      while (done % ticks != 0 || (time_step_before_ > 0. && ticks * tick > 2.0001 * time_step_before_))
        ticks /= 2;
      const Outcome outcome = try_step(ticks * tick);
      if (outcome == Outcome::accepted)
      {
        done += ticks;
        largest     = ticks_per_step;
        fresh_mesh  = false;
        now_.time_s = (grid_step_ + double(done) / ticks_per_step) * scene_.time.time_step_s();
      }
      else if (fluid_ && !fresh_mesh)
      {
        remesh();
        fresh_mesh = just_remeshed_ = true;
      }
      else if (halvings < scene_.numerics.max_step_halvings && ticks > 1)
      {
        ++halvings;
        ++counts_.n_step_halvings;
        largest = ticks / 2;
      }
      else
      {
        std::ostringstream message;
        message
            << "the step at t = " << now_.time_s << " s failed (" << cause(outcome) << ") after a remesh and "
            << halvings
            << " halvings of the step: raise [time] steps_per_period, refine [numerics] mesh_size_m, or check that the "
               "field, the magnetization and young_modulus_Pa are what you meant";
        throw ComputationError(message.str());
      }
    }
    ++grid_step_;
  }

  template <int dim>
  std::string FullOrderModel<dim>::cause(const Outcome outcome)
  {
    switch (outcome)
    {
    case Outcome::accepted:
      return "accepted";
    case Outcome::mesh_inverted:
      return "an element of the fluid's mesh was turned inside out";
    case Outcome::tail_inverted:
      return "an element of the tail was turned inside out";
    case Outcome::coupling_diverged:
      return "the coupling iteration did not converge";
    case Outcome::linear_solver_failed:
      return "the linear solver failed";
    }
    return "unknown";
  }

  template <int dim>
  Configuration<dim> FullOrderModel<dim>::known_part(const Bdf2 &bdf) const
  {
    const Configuration<dim> &now = now_.configuration, &before = time_step_before_ > 0. ? before_.configuration : now;
    Configuration<dim>        known;
    known.pose.center = Point<dim>(bdf.known(Tensor<1, dim>(now.pose.center), Tensor<1, dim>(before.pose.center)));
    known.pose.angle  = bdf.known(now.pose.angle, before.pose.angle);
    known.shape.resize(now.shape.size());
    for (unsigned int a = 0; a < now.shape.size(); ++a)
      known.shape[a] = bdf.known(now.shape[a], before.shape[a]);
    return known;
  }

  template <int dim>
  Rates<dim> FullOrderModel<dim>::extrapolated_rates(const double dt) const
  {
    if (time_step_before_ == 0.)
      return now_.rates;
    const double r      = dt / time_step_before_;
    Rates<dim>   result = now_.rates;
    result.velocity += r * (now_.rates.velocity - before_.rates.velocity);
    result.omega += r * (now_.rates.omega - before_.rates.omega);
    for (unsigned int a = 0; a < result.shape_rate.size(); ++a)
      result.shape_rate[a] += r * (now_.rates.shape_rate[a] - before_.rates.shape_rate[a]);
    return result;
  }

  template <int dim>
  std::vector<double> FullOrderModel<dim>::extrapolated_unknowns(const double              dt,
                                                                 const Configuration<dim> &configuration,
                                                                 const Rates<dim>         &rates) const
  {
    if (unknowns_.empty())
      return system_->guess({rates.velocity, rates.omega,
                             swimmer_.has_tail() ? swimmer_.tail_velocities(configuration, rates) : NodalField<dim>()});
    std::vector<double> result = unknowns_;
    if (!unknowns_before_.empty() && time_step_before_ > 0.)
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] += dt / time_step_before_ * (unknowns_[i] - unknowns_before_[i]);
    return result;
  }

  template <int dim>
  Configuration<dim> FullOrderModel<dim>::advance_kinematics(const Configuration<dim> &known, const double slope_weight,
                                                             const CoupledVelocities<dim> &velocities,
                                                             Rates<dim>                   &rates) const
  {
    Configuration<dim> next;
    rates.velocity   = velocities.head_velocity;
    rates.omega      = velocities.head_omega;
    next.pose.center = known.pose.center + slope_weight * rates.velocity;
    next.pose.angle  = known.pose.angle + slope_weight * rates.omega[0];
    if (!swimmer_.has_tail())
      return next;

    // w = U + omega x R (X + d) + R d', d = known + slope d': solve (1 + slope omega x) d = known + slope (R^T (w - U)
    // - omega x X).
    const Tensor<2, dim> inverse = inverse_of_step_rotation<dim>(rates.omega, slope_weight);
    const Tensor<2, dim> Rt      = transpose(next.pose.rotation());
    const auto          &mesh    = swimmer_.tail().mesh;
    next.shape.resize(mesh.n_nodes());
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      if (!swimmer_.is_clamped(a))
        next.shape[a] =
            inverse * (known.shape[a] + slope_weight * (Rt * (velocities.tail[a] - rates.velocity) -
                                                        rotational_velocity<dim>(rates.omega, mesh.nodes[a])));
    if (scene_.numerics.tail_order == 1)
      for (unsigned int e = 0; e < mesh.edges().size(); ++e)
        next.shape[mesh.n_vertices() + e] = .5 * (next.shape[mesh.edges()[e][0]] + next.shape[mesh.edges()[e][1]]);
    rates.shape_rate.resize(mesh.n_nodes());
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      rates.shape_rate[a] = (next.shape[a] - known.shape[a]) / slope_weight;
    return next;
  }

  template <int dim>
  typename FullOrderModel<dim>::Outcome FullOrderModel<dim>::try_step(const double dt)
  {
    const Bdf2               bdf(dt, time_step_before_);
    const double             time  = now_.time_s + dt;
    const Configuration<dim> known = known_part(bdf);

    Rates<dim>         rates = extrapolated_rates(dt);
    Configuration<dim> guess = known;
    guess.pose.center += bdf.slope_weight * rates.velocity;
    guess.pose.angle += bdf.slope_weight * rates.omega[0];
    for (unsigned int a = 0; a < guess.shape.size(); ++a)
      guess.shape[a] += bdf.slope_weight * rates.shape_rate[a];
    std::vector<double> unknowns = extrapolated_unknowns(dt, guess, rates);

    double change_before = 0.;
    for (int iteration = 1; iteration <= scene_.numerics.max_coupling_iterations; ++iteration)
    {
      const double start = cpu_seconds();
      if (fluid_ && !(fluid_->follow(swimmer_.surface(guess), guess.pose) > 0.))
        return Outcome::mesh_inverted;
      if (swimmer_.has_tail() && swimmer_.elasticity().is_inverted(guess.shape))
        return Outcome::tail_inverted;
      const double moved = cpu_seconds();
      counts_.mesh_motion_cpu_s += moved - start;
      ++counts_.n_coupling_iterations;
      ++iterations_of_last_step_;
      if (!system_->solve({guess, rates, bdf.slope_weight, time}, unknowns))
        return Outcome::linear_solver_failed;
      Configuration<dim> next   = advance_kinematics(known, bdf.slope_weight, system_->velocities(unknowns), rates);
      const double       change = swimmer_.relative_change(next, guess);
      counts_.coupling_cpu_s += cpu_seconds() - moved;
      guess = std::move(next);
      if (iteration == 2)
        contraction_ = {change / change_before, counts_.n_steps};
      if (!(change < far_too_far))
        return Outcome::coupling_diverged;
      // What is left to correct is estimated from the iteration's contraction: measured in this step, or, for the first
      // iteration, in a recent one.
      const double left_over =
          iteration == 1 ? contraction_.expected(counts_.n_steps) * change : change * change / change_before;
      if (left_over <= scene_.numerics.coupling_tolerance)
      {
        if (swimmer_.has_tail() && swimmer_.elasticity().is_inverted(guess.shape))
          return Outcome::tail_inverted;
        unknowns_before_ = std::move(unknowns_);
        unknowns_        = std::move(unknowns);
        accept(dt, std::move(guess), std::move(rates));
        return Outcome::accepted;
      }
      change_before = change;
    }
    return Outcome::coupling_diverged;
  }

  template <int dim>
  double FullOrderModel<dim>::Contraction::expected(const int step) const
  {
    constexpr int    valid_for_steps = 10;
    constexpr double safety          = 3.;
    return step - measured_at_step <= valid_for_steps ? safety * value : 1.;
  }

  template <int dim>
  void FullOrderModel<dim>::accept(const double dt, Configuration<dim> configuration, Rates<dim> rates)
  {
    before_           = std::move(now_);
    time_step_before_ = dt;
    now_              = {before_.time_s + dt, std::move(configuration), std::move(rates)};
    balance_          = system_->balance(now_.configuration, now_.rates, unknowns_, now_.time_s);
    ++counts_.n_steps;
    ++steps_since_remeshing_;
    remesh_is_due_ = fluid_ && wants_remeshing();
  }

  template <int dim>
  bool FullOrderModel<dim>::wants_remeshing() const
  {
    const int every = scene_.numerics.remesh_every_steps;
    return fluid_->quality() < scene_.numerics.remesh_quality || (every > 0 && steps_since_remeshing_ >= every);
  }

  template <int dim>
  void FullOrderModel<dim>::remesh()
  {
    const double start = cpu_seconds();
    const auto  &c     = now_.configuration;
    use_fluid_mesh(make_fluid_mesh(*scene_.domain, swimmer_.surface(c), swimmer_.surface_mesh_size(), c.pose,
                                   swimmer_.pose_at_rest(), scene_.numerics, communicator_),
                   c.pose);
    ++counts_.n_remeshes;
    counts_.remeshing_cpu_s += cpu_seconds() - start;
  }

  template <int dim>
  void FullOrderModel<dim>::use_fluid_mesh(FluidMesh<dim> mesh, const RigidPose<dim> &pose)
  {
    system_.reset(); // it refers to the old fluid
    fluid_  = std::make_unique<FluidDomain<dim>>(scene_, std::move(mesh), pose);
    system_ = std::make_unique<CoupledSystem<dim>>(swimmer_, fluid_.get(), linear_system_, communicator_);
    unknowns_.clear();
    unknowns_before_.clear();
    steps_since_remeshing_ = 0;
    remesh_is_due_         = false;
  }

  template <int dim>
  std::vector<double> FullOrderModel<dim>::fluid_values() const
  {
    if (!fluid_ || unknowns_.empty())
      return {};
    std::vector<double> rows = system_->expand(unknowns_);
    rows.resize(fluid_->n_rows()); // the tail's and the head's follow
    return rows;
  }

  template <int dim>
  ModelState<dim> FullOrderModel<dim>::state()
  {
    linear_system_.forget_factors();
    ModelState<dim> state;
    state.now                          = now_;
    state.before                       = before_;
    state.time_step_before_s           = time_step_before_;
    state.grid_step                    = grid_step_;
    state.steps_since_remeshing        = steps_since_remeshing_;
    state.unknowns                     = unknowns_;
    state.unknowns_before              = unknowns_before_;
    state.remesh_is_due                = remesh_is_due_;
    state.contraction_value            = contraction_.value;
    state.contraction_measured_at_step = contraction_.measured_at_step;
    state.counts                       = counts_;
    state.linear_counts                = linear_system_.counts();
    if (fluid_)
    {
      state.fluid_mesh      = record(fluid_->fluid_mesh());
      state.pose_at_meshing = fluid_->pose_at_meshing();
    }
    return state;
  }

  template <int dim>
  void FullOrderModel<dim>::restore(const ModelState<dim> &state)
  {
    if (state.fluid_mesh)
      use_fluid_mesh(make_fluid_mesh(*scene_.domain, *state.fluid_mesh, communicator_), state.pose_at_meshing);
    now_                   = state.now;
    before_                = state.before;
    time_step_before_      = state.time_step_before_s;
    grid_step_             = state.grid_step;
    steps_since_remeshing_ = state.steps_since_remeshing;
    unknowns_              = state.unknowns;
    unknowns_before_       = state.unknowns_before;
    remesh_is_due_         = state.remesh_is_due;
    contraction_           = {state.contraction_value, state.contraction_measured_at_step};
    counts_                = state.counts;
    linear_system_.set_counts(state.linear_counts);
  }

  template class FullOrderModel<2>;
} // namespace swimtwin
