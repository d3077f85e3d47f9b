// CVODES on the equations of one run: BDF, dense, analytic Jacobian, with sensitivities and work.
#pragma once

#include <rom/integration/integrator_options.h>
#include <rom/integration/phase_equations.h>
#include <rom/integration/sundials_handles.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Set up once; `start` begins a run anew without allocating. The equations' parameters and the options'
  /// sensitivities are the same.
  class PhaseIntegrator
  {
  public:
    PhaseIntegrator(const ReducedSwimmer &swimmer, const IntegratorOptions &options);
    ~PhaseIntegrator();
    PhaseIntegrator(const PhaseIntegrator &)            = delete;
    PhaseIntegrator &operator=(const PhaseIntegrator &) = delete;

    void start(const RunRequest &request);
    /// One step, to `stop` at most. False if CVODES gives up: see `failure`.
    bool        advance_one_step(double stop);
    std::string failure() const;

    bool                        with_work() const { return options_.with_work; }
    double                      phase() const { return phase_; }
    long                        n_steps() const { return n_steps_; }
    Eigen::Map<Eigen::VectorXd> state() const { return sundials::values(state_.get()); }
    /// The state at a phase within the last step.
    Eigen::VectorXd state_at(double phase);
    /// The state within the last step as a polynomial: column k times (phase - now)^k.
    Eigen::MatrixXd taylor_coefficients();
    /// d state / d parameter, one column each; SI.
    Eigen::MatrixXd sensitivities();
    /// The same at a phase within the last step.
    Eigen::MatrixXd sensitivities_at(double phase);
    /// Magnetic work and dissipation since the start (J/m).
    Eigen::Vector2d work();

    PhaseEquations       &equations() { return equations_; }
    const PhaseEquations &equations() const { return equations_; }

  private:
    void set_up_sensitivities();
    void set_tolerances(double frequency_Hz);
    void set_up_work();
    void start_sensitivities();
    void start_work();
    /// As they stand in sensitivities_.
    Eigen::MatrixXd unscaled_sensitivities() const;

    IntegratorOptions      options_;
    PhaseEquations         equations_;
    sundials::Context      context_;
    sundials::Vector       state_, tolerance_, work_, sample_;
    sundials::Matrix       matrix_;
    sundials::LinearSolver solver_;
    N_Vector              *sensitivities_ = nullptr;
    sundials::Integrator   integrator_;

    double phase_   = 0.;
    long   n_steps_ = 0;
    int    flag_    = 0;
  };
} // namespace swimtwin
