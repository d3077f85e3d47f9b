#include <rom/integration/phase_integrator.h>

#include <rom/integration/integration_failure.h>
#include <rom/swimmer/state_scale.h>

namespace swimtwin
{
  namespace
  {
    constexpr int n_powers = 2; // magnetic, dissipation

    // The stable wedge of order 5 is narrow: where the head swings back through the field, its steps shrink a
    // hundredfold before CVODES thinks of another order. Order 4 takes fewer of them and leaves smaller errors, until
    // tolerances are so tight that they alone keep the steps short.
    int max_order(const double relative_tolerance)
    {
      constexpr double tight = 1e-9;
      return relative_tolerance < tight ? 5 : 4;
    }

    // Of the local error: what Newton leaves at CVODES' 0.1 is noise in its estimates of the error, and costs more
    // steps than a sharper solution costs iterations.
    constexpr double newton_tolerance = 0.01;

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
  } // namespace

  PhaseIntegrator::PhaseIntegrator(const ReducedSwimmer &swimmer, const IntegratorOptions &options)
      : options_(options), equations_(swimmer, options.sensitivities), context_(sundials::make_context()),
        state_(sundials::made(N_VNew_Serial(swimmer.n_states(), context_.get()))),
        tolerance_(sundials::made(N_VClone(state_.get()))),
        work_(sundials::made(N_VNew_Serial(n_powers, context_.get()))), sample_(sundials::made(N_VClone(state_.get()))),
        matrix_(sundials::made(SUNDenseMatrix(swimmer.n_states(), swimmer.n_states(), context_.get()))),
        solver_(sundials::made(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get()))),
        integrator_(sundials::made(CVodeCreate(CV_BDF, context_.get())))
  {
    void *cv = integrator_.get();
    N_VConst(0., state_.get());
    CVodeSetErrHandlerFn(cv, sundials::ignore_message, nullptr);
    sundials::require_memory(CVodeInit(cv, on_rate, 0., state_.get()));
    CVodeSetUserData(cv, &equations_);
    sundials::require_memory(CVodeSetLinearSolver(cv, solver_.get(), matrix_.get()));
    sundials::require_memory(CVodeSetJacFn(cv, on_jacobian));
    CVodeSetMaxOrd(cv, max_order(options_.relative_tolerance));
    CVodeSetNonlinConvCoef(cv, newton_tolerance);
    CVodeSetMaxStep(cv, options_.max_step_periods);
    set_tolerances(1.);
    if (equations_.n_parameters() > 0)
      set_up_sensitivities();
    if (options_.with_work)
      set_up_work();
  }

  PhaseIntegrator::~PhaseIntegrator()
  {
    if (sensitivities_ != nullptr)
      N_VDestroyVectorArray(sensitivities_, equations_.n_parameters());
  }

  void PhaseIntegrator::set_up_sensitivities()
  {
    void *cv       = integrator_.get();
    sensitivities_ = sundials::made(N_VCloneVectorArray(equations_.n_parameters(), state_.get()));
    for (int i = 0; i < equations_.n_parameters(); ++i)
      N_VConst(0., sensitivities_[i]);
    sundials::require_memory(
        CVodeSensInit(cv, equations_.n_parameters(), CV_STAGGERED, on_sensitivities, sensitivities_));
    set_tolerances(1.);
    CVodeSetSensErrCon(cv, options_.control_sensitivity_errors);
  }

  /// Of a motion with inertia those of the velocities depend on the period.
  void PhaseIntegrator::set_tolerances(const double frequency_Hz)
  {
    const double rtol                  = options_.relative_tolerance;
    sundials::values(tolerance_.get()) = rtol * state_scale(equations_.swimmer(), frequency_Hz);
    sundials::require_memory(CVodeSVtolerances(integrator_.get(), rtol, tolerance_.get()));
    if (sensitivities_ == nullptr)
      return;
    std::vector<N_Vector> tolerances(static_cast<std::size_t>(equations_.n_parameters()), tolerance_.get());
    sundials::require_memory(CVodeSensSVtolerances(integrator_.get(), rtol, tolerances.data()));
  }

  void PhaseIntegrator::set_up_work()
  {
    N_VConst(0., work_.get());
    sundials::require_memory(CVodeQuadInit(integrator_.get(), on_power, work_.get()));
    CVodeSetQuadErrCon(integrator_.get(), true);
  }

  void PhaseIntegrator::start(const RunRequest &request)
  {
    equations_.start(request);
    phase_   = 0.;
    n_steps_ = 0;
    flag_    = CV_SUCCESS;
    state()  = request.initial_state;
    CVodeReInit(integrator_.get(), 0., state_.get());
    if (equations_.swimmer().has_inertia())
      set_tolerances(request.drive.frequency_Hz);
    if (sensitivities_ != nullptr)
      start_sensitivities();
    if (options_.with_work)
      start_work();
  }

  void PhaseIntegrator::start_sensitivities()
  {
    for (int i = 0; i < equations_.n_parameters(); ++i)
      equations_.set_initial_sensitivity(i, sundials::values(sensitivities_[i]));
    CVodeSensReInit(integrator_.get(), CV_STAGGERED, sensitivities_);
  }

  void PhaseIntegrator::start_work()
  {
    constexpr double tiny = 1e-300; // for a swimmer without a magnet, whose work is zero
    const double     rtol = options_.relative_tolerance;
    N_VConst(0., work_.get());
    CVodeQuadReInit(integrator_.get(), work_.get());
    sundials::require_memory(CVodeQuadSStolerances(integrator_.get(), rtol, rtol * equations_.work_scale_J_m() + tiny));
  }

  bool PhaseIntegrator::advance_one_step(const double stop)
  {
    if (++n_steps_ > options_.max_steps)
    {
      flag_ = CV_TOO_MUCH_WORK;
      return false;
    }
    double reached = phase_;
    CVodeSetStopTime(integrator_.get(), stop);
    flag_  = CVode(integrator_.get(), stop, state_.get(), &reached, CV_ONE_STEP);
    phase_ = flag_ == CV_TSTOP_RETURN ? stop : reached;
    return flag_ >= 0;
  }

  std::string PhaseIntegrator::failure() const
  {
    return flag_ >= 0 ? "" : integration_failure(flag_, options_.max_steps);
  }

  Eigen::VectorXd PhaseIntegrator::state_at(const double phase)
  {
    if (n_steps_ == 0)
      return state();
    CVodeGetDky(integrator_.get(), phase, 0, sample_.get());
    return sundials::values(sample_.get());
  }

  Eigen::MatrixXd PhaseIntegrator::taylor_coefficients()
  {
    int order = 0;
    CVodeGetLastOrder(integrator_.get(), &order);
    Eigen::MatrixXd coefficients(state().size(), order + 1);
    double          factorial = 1.;
    for (int k = 0; k <= order; factorial *= ++k)
    {
      CVodeGetDky(integrator_.get(), phase_, k, sample_.get());
      coefficients.col(k) = sundials::values(sample_.get()) / factorial;
    }
    return coefficients;
  }

  Eigen::MatrixXd PhaseIntegrator::unscaled_sensitivities() const
  {
    Eigen::MatrixXd columns(state().size(), equations_.n_parameters());
    for (int i = 0; i < equations_.n_parameters(); ++i)
      columns.col(i) = sundials::values(sensitivities_[i]) / equations_.scale(i);
    return columns;
  }

  Eigen::MatrixXd PhaseIntegrator::sensitivities()
  {
    double reached = 0.;
    if (sensitivities_ != nullptr && n_steps_ > 0)
      CVodeGetSens(integrator_.get(), &reached, sensitivities_);
    return unscaled_sensitivities();
  }

  Eigen::MatrixXd PhaseIntegrator::sensitivities_at(const double phase)
  {
    if (sensitivities_ != nullptr && n_steps_ > 0)
      CVodeGetSensDky(integrator_.get(), phase, 0, sensitivities_);
    return unscaled_sensitivities();
  }

  Eigen::Vector2d PhaseIntegrator::work()
  {
    double reached = 0.;
    if (options_.with_work && n_steps_ > 0)
      CVodeGetQuad(integrator_.get(), &reached, work_.get());
    return sundials::values(work_.get());
  }
} // namespace swimtwin
