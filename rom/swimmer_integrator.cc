#include <rom/phase_equations.h>
#include <rom/sundials_handles.h>
#include <rom/swimmer_integrator.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr int    n_powers          = 2;    // magnetic, dissipation
    constexpr double stroke_per_length = 0.03; // of a swimmer's shape and of its path in a period

    PhaseEquations &equations(void *data)
    {
      return *static_cast<PhaseEquations *>(data);
    }

    // CVODES takes 0 for success and a positive number for "try a smaller step".

    int on_rate(const realtype phase, N_Vector state, N_Vector rate, void *data)
    {
      auto rates = sundials::values(rate);
      equations(data).rate(phase, sundials::values(state), rates);
      return rates.allFinite() ? 0 : 1;
    }

    int on_jacobian(const realtype phase, N_Vector state, N_Vector, SUNMatrix jacobian, void *data, N_Vector, N_Vector,
                    N_Vector)
    {
      const auto                  n = static_cast<Eigen::Index>(SM_COLUMNS_D(jacobian));
      Eigen::Map<Eigen::MatrixXd> entries(SM_DATA_D(jacobian), n, n);
      equations(data).jacobian(phase, sundials::values(state), entries);
      return entries.allFinite() ? 0 : 1;
    }

    int on_sensitivities(const int n, const realtype phase, N_Vector state, N_Vector, N_Vector *sensitivities,
                         N_Vector *rates, void *data, N_Vector, N_Vector)
    {
      for (int i = 0; i < n; ++i)
        equations(data).sensitivity_rate(phase, sundials::values(state), i, sundials::values(sensitivities[i]),
                                         sundials::values(rates[i]));
      return 0;
    }

    int on_power(const realtype phase, N_Vector state, N_Vector power, void *data)
    {
      equations(data).power(phase, sundials::values(state), sundials::values(power));
      return 0;
    }

    void ignore_message(int, const char *, const char *, char *, void *) {}

    std::string cause(const int flag, const long max_steps)
    {
      switch (flag)
      {
      case CV_TOO_MUCH_WORK:
        return fmt::format("more than {} steps are needed", max_steps);
      case CV_ERR_FAILURE:
        return "the error per step stays above the tolerance for the smallest step";
      case CV_CONV_FAILURE:
        return "Newton's method does not converge for the smallest step";
      case CV_TOO_MUCH_ACC:
        return "the tolerance is below what double precision allows";
      case CV_RHSFUNC_FAIL:
      case CV_FIRST_RHSFUNC_ERR:
      case CV_REPTD_RHSFUNC_ERR:
      case CV_LSETUP_FAIL:
        return "a rate is not finite: the motion leaves what the model can describe";
      default:
        return "CVODES gives up";
      }
    }

    double unwrap(const double angle, const double previous)
    {
      return angle + 2. * std::numbers::pi * std::round((previous - angle) / (2. * std::numbers::pi));
    }
  } // namespace

  class SwimmerIntegrator::Memory
  {
  public:
    Memory(const ReducedSwimmer &swimmer, const IntegratorOptions &options);
    ~Memory();
    SwimmerRun run(const RunRequest &request);

  private:
    void   set_up_sensitivities();
    void   set_up_work();
    void   restart(const RunRequest &request);
    void   advance_one_period(const RunRequest &request, int period, SwimmerRun &run);
    int    advance_one_step(double period_end);
    double next_stop(double period_end) const;
    void   take_samples(const RunRequest &request, double previous_phase, SwimmerRun &run);
    void   add_row(double phase, const Eigen::VectorXd &state, SwimmerRun &run);
    void   keep_state(SwimmerRun &run);
    void   keep_work(SwimmerRun &run);
    void   watch_trust(SwimmerRun &run) const;
    void   count(SwimmerRun &run) const;

    IntegratorOptions      options_;
    PhaseEquations         equations_;
    sundials::Context      context_;
    sundials::Vector       state_, tolerance_, powers_, sample_;
    sundials::Matrix       matrix_;
    sundials::LinearSolver solver_;
    N_Vector              *sensitivities_ = nullptr;
    sundials::Integrator   integrator_;

    std::vector<double> kinks_;
    double              phase_ = 0., period_s_ = 0.;
    long                n_steps_ = 0;
  };

  SwimmerIntegrator::Memory::Memory(const ReducedSwimmer &swimmer, const IntegratorOptions &options)
      : options_(options), equations_(swimmer, options.sensitivities), context_(sundials::make_context()),
        state_(sundials::made(N_VNew_Serial(swimmer.n_states(), context_.get()))),
        tolerance_(sundials::made(N_VClone(state_.get()))),
        powers_(sundials::made(N_VNew_Serial(n_powers, context_.get()))),
        sample_(sundials::made(N_VClone(state_.get()))),
        matrix_(sundials::made(SUNDenseMatrix(swimmer.n_states(), swimmer.n_states(), context_.get()))),
        solver_(sundials::made(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get()))),
        integrator_(sundials::made(CVodeCreate(CV_BDF, context_.get())))
  {
    const double rtol = options_.relative_tolerance;
    void        *cv   = integrator_.get();
    N_VConst(0., state_.get());
    sundials::values(tolerance_.get()).setConstant(rtol * stroke_per_length * swimmer.length_m());
    sundials::values(tolerance_.get())[2] = rtol;
    CVodeSetErrHandlerFn(cv, ignore_message, nullptr);
    CVodeInit(cv, on_rate, 0., state_.get());
    CVodeSetUserData(cv, &equations_);
    CVodeSVtolerances(cv, rtol, tolerance_.get());
    CVodeSetLinearSolver(cv, solver_.get(), matrix_.get());
    CVodeSetJacFn(cv, on_jacobian);
    CVodeSetMaxStep(cv, options_.max_step_periods);
    if (equations_.n_parameters() > 0)
      set_up_sensitivities();
    if (options_.with_work)
      set_up_work();
  }

  SwimmerIntegrator::Memory::~Memory()
  {
    if (sensitivities_ != nullptr)
      N_VDestroyVectorArray(sensitivities_, equations_.n_parameters());
  }

  void SwimmerIntegrator::Memory::set_up_sensitivities()
  {
    void *cv       = integrator_.get();
    sensitivities_ = sundials::made(N_VCloneVectorArray(equations_.n_parameters(), state_.get()));
    std::vector<N_Vector> tolerances(static_cast<std::size_t>(equations_.n_parameters()), tolerance_.get());
    for (int i = 0; i < equations_.n_parameters(); ++i)
      N_VConst(0., sensitivities_[i]);
    CVodeSensInit(cv, equations_.n_parameters(), CV_STAGGERED, on_sensitivities, sensitivities_);
    CVodeSensSVtolerances(cv, options_.relative_tolerance, tolerances.data());
    CVodeSetSensErrCon(cv, options_.control_sensitivity_errors);
  }

  void SwimmerIntegrator::Memory::set_up_work()
  {
    N_VConst(0., powers_.get());
    CVodeQuadInit(integrator_.get(), on_power, powers_.get());
    CVodeSetQuadErrCon(integrator_.get(), true);
  }

  void SwimmerIntegrator::Memory::restart(const RunRequest &request)
  {
    void *cv = integrator_.get();
    equations_.start(request);
    kinks_                         = request.drive.field->kinks();
    period_s_                      = 1. / request.drive.frequency_Hz;
    phase_                         = 0.;
    n_steps_                       = 0;
    sundials::values(state_.get()) = request.initial_state;
    CVodeReInit(cv, 0., state_.get());
    for (int i = 0; i < equations_.n_parameters(); ++i)
      equations_.set_initial_sensitivity(i, sundials::values(sensitivities_[i]));
    if (sensitivities_ != nullptr)
      CVodeSensReInit(cv, CV_STAGGERED, sensitivities_);
    if (options_.with_work)
    {
      constexpr double tiny = 1e-300; // a swimmer without a magnet: its work is zero
      N_VConst(0., powers_.get());
      CVodeQuadReInit(cv, powers_.get());
      CVodeQuadSStolerances(cv, options_.relative_tolerance,
                            options_.relative_tolerance * equations_.work_scale_J_m() + tiny);
    }
  }

  SwimmerRun SwimmerIntegrator::Memory::run(const RunRequest &request)
  {
    restart(request);
    SwimmerRun run;
    keep_state(run);
    watch_trust(run);
    if (request.samples_per_period > 0)
      add_row(0., sundials::values(state_.get()), run);
    for (int period = 0; period < request.n_periods && run.status != RunStatus::failed; ++period)
      advance_one_period(request, period, run);
    if (run.status != RunStatus::failed)
      run.status = RunStatus::completed;
    count(run);
    return run;
  }

  void SwimmerIntegrator::Memory::advance_one_period(const RunRequest &request, const int period, SwimmerRun &run)
  {
    const double end = period + 1.;
    while (phase_ < end)
    {
      const double previous = phase_;
      const int    flag     = advance_one_step(end);
      if (flag < 0)
      {
        run.status  = RunStatus::failed;
        run.failure = fmt::format("the reduced swimmer stopped {:.4g} periods after its start: {}", phase_,
                                  cause(flag, options_.max_steps));
        return;
      }
      watch_trust(run);
      take_samples(request, previous, run);
    }
    keep_state(run);
    if (options_.with_work)
      keep_work(run);
  }

  int SwimmerIntegrator::Memory::advance_one_step(const double period_end)
  {
    if (++n_steps_ > options_.max_steps)
      return CV_TOO_MUCH_WORK;
    const double stop = next_stop(period_end);
    CVodeSetStopTime(integrator_.get(), stop);
    double    reached = phase_;
    const int flag    = CVode(integrator_.get(), stop, state_.get(), &reached, CV_ONE_STEP);
    phase_            = flag == CV_TSTOP_RETURN ? stop : reached;
    return flag;
  }

  /// The period's end, or the next kink of the field before it.
  double SwimmerIntegrator::Memory::next_stop(const double period_end) const
  {
    constexpr double round_off = 1e-12;
    for (const double kink : kinks_)
      if (const double stop = period_end - 1. + kink; stop > phase_ + round_off && stop < period_end - round_off)
        return stop;
    return period_end;
  }

  void SwimmerIntegrator::Memory::take_samples(const RunRequest &request, const double previous_phase, SwimmerRun &run)
  {
    const int n = request.samples_per_period;
    if (n == 0)
      return;
    for (auto i = static_cast<long>(run.trajectory.size()); i <= std::lround(std::floor(phase_ * n)); ++i)
    {
      const double at = std::max(static_cast<double>(i) / n, previous_phase);
      CVodeGetDky(integrator_.get(), at, 0, sample_.get());
      add_row(at, sundials::values(sample_.get()), run);
    }
  }

  void SwimmerIntegrator::Memory::add_row(const double phase, const Eigen::VectorXd &state, SwimmerRun &run)
  {
    const ReducedSwimmer    &swimmer = equations_.swimmer();
    const ShapeVector        q       = state.tail(swimmer.n_modes());
    const Eigen::Rotation2Dd R(state[2]);
    const Eigen::Vector2d    tip = state.head<2>() + R * swimmer.tip().position_m(q), b = equations_.field_T(phase);
    const SwimmerMotion     &motion = equations_.motion(phase, state);
    TrajectoryRow            row;
    row.time_s             = phase * period_s_;
    row.head_x_m           = state[0];
    row.head_y_m           = state[1];
    row.head_angle_rad     = state[2];
    row.tail_tip_x_m       = tip.x();
    row.tail_tip_y_m       = tip.y();
    row.tail_angle_rad     = unwrap(state[2] + swimmer.tip().angle_rad(q),
                                run.trajectory.empty() ? state[2] : run.trajectory.back().tail_angle_rad);
    row.bx_T               = b.x();
    row.by_T               = b.y();
    row.magnetic_power_W_m = motion.magnetic_power_W_m;
    row.dissipation_W_m    = motion.dissipation_W_m;
    row.elastic_energy_J_m = equations_.elastic_energy_J_m(state);
    row.n_unknowns         = swimmer.n_states();
    run.trajectory.push_back(row);
    run.snapshots.push_back({phase, state, motion.rate});
  }

  void SwimmerIntegrator::Memory::keep_state(SwimmerRun &run)
  {
    run.at_period_end.emplace_back(sundials::values(state_.get()));
    if (sensitivities_ == nullptr)
      return;
    double at = 0.;
    if (phase_ > 0.)
      CVodeGetSens(integrator_.get(), &at, sensitivities_);
    Eigen::MatrixXd by_parameters(equations_.swimmer().n_states(), equations_.n_parameters());
    for (int i = 0; i < equations_.n_parameters(); ++i)
      by_parameters.col(i) = sundials::values(sensitivities_[i]) / equations_.scale(i);
    run.sensitivity_at_period_end.push_back(std::move(by_parameters));
  }

  void SwimmerIntegrator::Memory::keep_work(SwimmerRun &run)
  {
    double at = 0.;
    CVodeGetQuad(integrator_.get(), &at, powers_.get());
    const auto so_far = sundials::values(powers_.get());
    PeriodWork work{so_far[0], so_far[1],
                    equations_.elastic_energy_J_m(run.at_period_end.back()) -
                        equations_.elastic_energy_J_m(*(run.at_period_end.end() - 2))};
    for (const PeriodWork &before : run.work)
    {
      work.magnetic -= before.magnetic;
      work.dissipated -= before.dissipated;
    }
    run.work.push_back(work);
  }

  void SwimmerIntegrator::Memory::watch_trust(SwimmerRun &run) const
  {
    const ReducedSwimmer &swimmer = equations_.swimmer();
    const auto            state   = sundials::values(state_.get());
    run.largest_shape_radius =
        std::max(run.largest_shape_radius, swimmer.resistance().shape_radius(state.tail(swimmer.n_modes())));
    run.largest_angle_radius = std::max(run.largest_angle_radius, swimmer.resistance().angle_radius(state[2]));
  }

  void SwimmerIntegrator::Memory::count(SwimmerRun &run) const
  {
    run.n_steps            = n_steps_;
    run.n_rate_evaluations = equations_.n_rate_evaluations;
    run.n_jacobians        = equations_.n_jacobians;
  }

  SwimmerIntegrator::SwimmerIntegrator(const ReducedSwimmer &swimmer, const IntegratorOptions &options)
      : memory_(std::make_unique<Memory>(swimmer, options))
  {
  }

  SwimmerIntegrator::~SwimmerIntegrator()                             = default;
  SwimmerIntegrator::SwimmerIntegrator(SwimmerIntegrator &&) noexcept = default;

  SwimmerRun SwimmerIntegrator::run(const RunRequest &request)
  {
    return memory_->run(request);
  }
} // namespace swimtwin
