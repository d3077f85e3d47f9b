#include <fom/step/full_order_model.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/surface/surface_distance.h>
#include <datasets/system/error.h>
#include <fom/algebra/cpu_time.h>
#include <fom/body/given_motion.h>
#include <fom/body/mesh_around.h>
#include <fom/fluid/flow_transfer.h>
#include <fom/step/step_formula.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// One step of the time grid is divided into so many ticks; smaller steps are whole powers of two of them.
    constexpr int ticks_per_step = 1024;
    /// The run starts with an eighth of a step, by backward Euler, then doubles: the start's error is a 64th.
    constexpr int ticks_of_first_step = ticks_per_step / 8;

    /// Distance (m) of the closest of some points to a wall that does not move with them; infinite without one.
    template <int dim>
    double distance_to_walls(const Domain &domain, const std::vector<Point<dim>> &points)
    {
      double     least = std::numeric_limits<double>::infinity();
      Point<dim> center;
      for (int c = 0; c < 2; ++c)
        center[c] = domain.center_m[c];
      if (domain.surface)
      {
        const SurfaceDistance distance(*domain.surface);
        for (const auto &x : points)
          least = std::min(least, distance.to({x[0], x[1], x[dim - 1]}));
        return least;
      }
      const std::array<double, 3> size{domain.size_m[0], domain.size_m[1], domain.size_z_m};
      for (const auto &x : points)
      {
        const Tensor<1, dim> r = x - center;
        if (domain.shape == DomainShape::box || domain.shape == DomainShape::channel)
          for (int c = 0; c < dim; ++c)
            least = std::min(least, size[c] / 2 - std::abs(r[c]));
        else if (domain.shape == DomainShape::cylinder)
          least = std::min({least, size[0] / 2 - std::abs(r[0]), domain.radius_m - std::hypot(r[1], r[dim - 1])});
        else if (!domain.moves_with_swimmer)
          least = std::min(least, domain.radius_m - r.norm());
        if (domain.shape == DomainShape::annulus)
          least = std::min(least, r.norm() - domain.inner_radius_m);
      }
      return least;
    }

    /// Time (s) that a stream or a fall takes to pass the body.
    double time_of_passage(const Scene &scene)
    {
      const double length = scene.body_length_m(), speed = largest_imposed_speed_m_s(scene);
      const auto  &g       = scene.gravity.acceleration_m_s2;
      const double gravity = std::hypot(g[0], g[1], g[2]);
      return speed > 0. ? length / speed : gravity > 0. ? std::sqrt(length / gravity) : 1.;
    }
  } // namespace

  template <int dim>
  FullOrderModel<dim>::FullOrderModel(const Scene &scene, const MPI_Comm communicator)
      : scene_(scene), communicator_(communicator), swimmer_(scene, communicator),
        coupling_(make_coupling(swimmer_, communicator)), follows_way_(starts_under_load(swimmer_))
  {
    start_at_rest();
    if (scene.fluid)
    {
      mesh_at_start();
      counts_.n_remeshes = 0; // the first mesh is not a remeshing
    }
    else
      coupling_->use_fluid(nullptr);
    solve_initial_flow();
  }

  template <int dim>
  FullOrderModel<dim>::FullOrderModel(const Scene &scene, BodyMesh<dim> body, FluidMesh<dim> fluid,
                                      const MPI_Comm communicator)
      : scene_(scene), communicator_(communicator), swimmer_(scene, std::move(body)),
        coupling_(make_coupling(swimmer_, communicator)), follows_way_(starts_under_load(swimmer_))
  {
    start_at_rest();
    use_fluid(std::make_unique<FluidDomain<dim>>(scene, std::move(fluid), now_.configuration.pose));
    solve_initial_flow();
  }

  template <int dim>
  void FullOrderModel<dim>::start_at_rest()
  {
    now_.configuration = swimmer_.configuration_at_rest();
    take_given_configuration(swimmer_, 0., now_.configuration);
    now_.rates.shape_rate.resize(now_.configuration.shape.size());
  }

  template <int dim>
  void FullOrderModel<dim>::solve_initial_flow()
  {
    // Without a tail and inertia the velocities follow from the position alone; else the run starts from rest.
    if (swimmer_.has_tail() || inertia_terms(scene_).any())
      return;
    if (scene_.head.is_driven())
    {
      const auto given    = given_pose<dim>(scene_.head, 0.);
      now_.rates.velocity = given.velocity;
      now_.rates.omega    = given.omega;
    }
    const TimeStep<dim> no_step{known_configuration(swimmer_, Bdf2(0., 0.), now_, now_), 0., 0., 0., 0};
    if (coupling_->solve(no_step, now_.configuration, now_.rates) != StepOutcome::accepted)
      throw ComputationError("the flow at the start could not be solved: refine [numerics] mesh_size_m");
    balance_ = compute_balance();
  }

  template <int dim>
  PowerBalance FullOrderModel<dim>::compute_balance(const std::optional<BodyVelocities<dim>> &acceleration) const
  {
    return power_balance(swimmer_, fluid_.get(), coupling_->fluid_values(), now_.configuration, now_.rates, now_.time_s,
                         acceleration);
  }

  template <int dim>
  void FullOrderModel<dim>::advance()
  {
    iterations_of_last_step_ = 0;
    just_remeshed_           = false;
    if (scene_.time.is_steady)
      advance_to_steady_state();
    else
      advance_in_time();
    ++grid_step_;
  }

  template <int dim>
  void FullOrderModel<dim>::advance_to_steady_state()
  {
    // Backward Euler steps from rest, each ten times as long as the one before: Newton's method in the end, and its
    // path there is one that the swimmer could take.
    constexpr int    most_steps = 60;
    constexpr double growth = 10., longest = 1e6;
    const double     unit     = time_of_passage(scene_);
    double           dt       = 100. * unit;
    int              failures = 0;
    for (int n = 0; n < most_steps; ++n)
    {
      time_step_before_                      = 0.;
      const Configuration<dim> configuration = now_.configuration;
      const double             time_s        = now_.time_s;
      const StepOutcome        outcome       = try_step(dt);
      now_.time_s                            = time_s; // there is none
      if (outcome != StepOutcome::accepted)
      {
        if (++failures > scene_.numerics.max_step_halvings + 6)
          give_up(outcome, failures);
        dt /= growth;
        continue;
      }
      const double change =
          std::max(swimmer_.relative_change(configuration, now_.configuration), coupling_->flow_change());
      if (change <= scene_.numerics.coupling_tolerance && dt >= unit)
      {
        now_.time_s = scene_.time.time_step_s();
        return;
      }
      dt = std::min(growth * dt, longest * unit);
      if (fluid_ && wants_remeshing() && remesh())
        just_remeshed_ = true;
    }
    throw ComputationError(
        "no steady state was found: the flow may have none; leave out [time] steady and follow it in time");
  }

  template <int dim>
  void FullOrderModel<dim>::advance_in_time()
  {
    work_.reset();
    if (follows_way_)
      work_.emplace();
    const PowerBalance balance_then = balance_;
    const double       tick         = scene_.time.time_step_s() / ticks_per_step;
    bool               fresh_mesh   = steps_since_remeshing_ == 0;
    int                largest = time_step_before_ == 0. ? ticks_of_first_step : ticks_per_step, halvings = 0;
    int                longest = ticks_per_step;
    for (int done = 0; done < ticks_per_step;)
    {
      // A new mesh is made just before it is needed, so that the fields of every instant can still be read.
      if (std::exchange(remesh_is_due_, false) && remesh())
        fresh_mesh = just_remeshed_ = true;
      const int         ticks   = next_ticks(done, largest);
      const StepOutcome outcome = try_step(ticks * tick);
      if (outcome == StepOutcome::accepted)
      {
        done += ticks;
        largest     = longest;
        fresh_mesh  = false;
        now_.time_s = (grid_step_ + double(done) / ticks_per_step) * scene_.time.time_step_s();
      }
      else if (fluid_ && !fresh_mesh && outcome != StepOutcome::unstable_equilibrium)
      {
        fresh_mesh = true; // or there is none to be had
        if (remesh())
          just_remeshed_ = true;
      }
      else if (halvings < scene_.numerics.max_step_halvings && ticks > 1)
      {
        ++halvings;
        ++counts_.n_step_halvings;
        largest = ticks / 2;
        if (outcome == StepOutcome::unstable_equilibrium)
          longest = largest; // what is too long remains so for a while
      }
      else
        give_up(outcome, halvings);
    }
    if (follows_way_ && grid_step_ > 0 && powers_are_smooth_again(balance_then, balance_))
    {
      work_.reset();
      follows_way_ = false;
    }
    follows_way_ = follows_way_ && grid_step_ + 1 < n_start_steps(scene_.time);
  }

  template <int dim>
  int FullOrderModel<dim>::next_ticks(const int done, const int largest) const
  {
    // The largest power of two that fits the grid, is allowed, and at most doubles the last step.
    const double tick  = scene_.time.time_step_s() / ticks_per_step;
    int          ticks = largest;
    while (done % ticks != 0 || (time_step_before_ > 0. && ticks * tick > 2.0001 * time_step_before_))
      ticks /= 2;
    return ticks;
  }

  template <int dim>
  void FullOrderModel<dim>::give_up(const StepOutcome outcome, const int halvings) const
  {
    std::ostringstream message;
    const bool         is_about_time = outcome == StepOutcome::unstable_equilibrium; // neither mesh nor walls
    message << "the step at t = " << now_.time_s << " s failed (" << cause(outcome) << ") after "
            << (is_about_time ? "" : "a remesh and ") << halvings << " halvings of the step: ";
    const double distance =
        fluid_ ? distance_to_walls<dim>(*scene_.domain, swimmer_.surface(now_.configuration)) : scene_.body_length_m();
    if (!is_about_time && distance < .5 * scene_.numerics.mesh_size_m)
      message << "the body is " << distance << " m from a wall, and contact is not modelled; enlarge the domain, move "
              << "the head, lower the field, or end the run before";
    else if ((outcome == StepOutcome::mesh_inverted || outcome == StepOutcome::mesh_motion_failed) &&
             !why_no_mesh_.empty())
      message << "a new one was not to be had, for " << why_no_mesh_ << ", or " << shorter_steps(scene_);
    else
      message << remedy(outcome, scene_);
    throw ComputationError(message.str());
  }

  template <int dim>
  StepOutcome FullOrderModel<dim>::try_step(const double dt)
  {
    const Bdf2          bdf(dt, time_step_before_);
    const double        growth = time_step_before_ > 0. ? dt / time_step_before_ : 0.;
    const Instant<dim> &before = time_step_before_ > 0. ? before_ : now_;
    const TimeStep<dim> step{
        known_configuration(swimmer_, bdf, now_, before), bdf.slope_weight, now_.time_s + dt, growth, counts_.n_steps,
        known_velocities(swimmer_, bdf, now_, before)};
    if (fluid_)
      fluid_->begin_step(bdf);

    Rates<dim> rates = extrapolated_rates(now_, before, growth);
    take_given_rates(swimmer_, step, rates);
    Configuration<dim> configuration = step.known;
    configuration.pose.turn(bdf.slope_weight * rates.omega);
    for (unsigned int a = 0; a < configuration.shape.size(); ++a)
      configuration.shape[a] += bdf.slope_weight * rates.shape_rate[a];
    configuration.pose.center = head_center(swimmer_, step, configuration, rates);

    const int         iterations_before = coupling_->counts().n_iterations;
    const StepOutcome outcome           = coupling_->solve(step, configuration, rates);
    iterations_of_last_step_ += coupling_->counts().n_iterations - iterations_before;
    if (outcome == StepOutcome::accepted)
      accept(dt, step, std::move(configuration), std::move(rates));
    return outcome;
  }

  template <int dim>
  void FullOrderModel<dim>::accept(const double dt, const TimeStep<dim> &step, Configuration<dim> configuration,
                                   Rates<dim> rates)
  {
    const bool is_first               = time_step_before_ == 0.;
    before_                           = std::move(now_);
    time_step_before_                 = dt;
    now_                              = {before_.time_s + dt, std::move(configuration), std::move(rates)};
    const PowerBalance balance_before = std::exchange(balance_, compute_balance(acceleration(swimmer_, step, now_)));
    if (fluid_)
      fluid_->end_step(coupling_->fluid_values());
    if (work_)
      *work_ += work_along_the_way(swimmer_, before_, is_first ? nullptr : &balance_before, now_, balance_);
    ++counts_.n_steps;
    ++steps_since_remeshing_;
    remesh_is_due_ = fluid_ && wants_remeshing();
  }

  template <int dim>
  bool FullOrderModel<dim>::wants_remeshing() const
  {
    const int every = scene_.numerics.remesh_every_steps;
    if (every > 0 && steps_since_remeshing_ >= every)
      return true;
    // A mesh that was hardly better when it was made, in a narrow gap, would be made again at every step.
    const double quality = fluid_->quality();
    return quality < scene_.numerics.remesh_quality &&
           quality < .5 * worst_quality(fluid_->mesh(), fluid_->mesh().nodes);
  }

  template <int dim>
  void FullOrderModel<dim>::mesh_at_start()
  {
    // At rest the scene's settings were to blame already; a tail that begins bent is the scene's doing, too.
    const bool is_told = scene_.tail && scene_.tail->is_driven();
    try
    {
      if (!remesh())
        throw ComputationError(why_no_mesh_);
    }
    catch (const OutOfMemory &)
    {
      throw;
    }
    catch (const ComputationError &error)
    {
      if (!is_told)
        throw;
      throw InputError(fmt::format("{}: {}", scene_.name, error.what()));
    }
  }

  template <int dim>
  bool FullOrderModel<dim>::remesh()
  {
    const ScopedCpuTime time(counts_.remeshing_cpu_s);
    const auto         &c = now_.configuration;
    try
    {
      auto fluid = std::make_unique<FluidDomain<dim>>(scene_, mesh_around(swimmer_, c, communicator_), c.pose);
      if (fluid_ && fluid_->inertia().of_fluid())
        fluid->set_past(transfer_past(*fluid_, *fluid));
      use_fluid(std::move(fluid));
    }
    catch (const OutOfMemory &)
    {
      throw;
    }
    catch (const ComputationError &error)
    {
      if (failed_for_the_place(error))
      {
        why_no_mesh_ = error.what(); // the old mesh is still good, or shorter steps may be
        return false;
      }
      std::ostringstream message;
      message << "at t = " << now_.time_s << " s " << error.what();
      throw ComputationError(message.str());
    }
    why_no_mesh_.clear();
    ++counts_.n_remeshes;
    return true;
  }

  template <int dim>
  void FullOrderModel<dim>::use_fluid(std::unique_ptr<FluidDomain<dim>> fluid)
  {
    coupling_->use_fluid(fluid.get()); // lets go of the old one
    fluid_                 = std::move(fluid);
    steps_since_remeshing_ = 0;
    remesh_is_due_         = false;
  }

  template <int dim>
  ModelState<dim> FullOrderModel<dim>::state()
  {
    ModelState<dim> state;
    state.now                   = now_;
    state.before                = before_;
    state.time_step_before_s    = time_step_before_;
    state.grid_step             = grid_step_;
    state.steps_since_remeshing = steps_since_remeshing_;
    state.remesh_is_due         = remesh_is_due_;
    state.counts                = counts_;
    state.coupling              = coupling_->state();
    if (follows_way_)
      state.balance = balance_;
    if (fluid_)
    {
      state.fluid_past      = fluid_->past();
      state.fluid_mesh      = record(fluid_->fluid_mesh());
      state.pose_at_meshing = fluid_->pose_at_meshing();
    }
    return state;
  }

  template <int dim>
  void FullOrderModel<dim>::restore(const ModelState<dim> &state)
  {
    if (state.fluid_mesh)
    {
      auto fluid = std::make_unique<FluidDomain<dim>>(
          scene_, make_fluid_mesh(*scene_.domain, *state.fluid_mesh, communicator_), state.pose_at_meshing);
      fluid->set_past(state.fluid_past);
      use_fluid(std::move(fluid));
    }
    now_                   = state.now;
    before_                = state.before;
    time_step_before_      = state.time_step_before_s;
    grid_step_             = state.grid_step;
    steps_since_remeshing_ = state.steps_since_remeshing;
    remesh_is_due_         = state.remesh_is_due;
    counts_                = state.counts;
    follows_way_           = state.balance.has_value();
    if (follows_way_)
      balance_ = *state.balance;
    coupling_->restore(state.coupling);
  }

  template class FullOrderModel<2>;
  template class FullOrderModel<3>;
} // namespace swimtwin
