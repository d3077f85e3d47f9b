// The derivative of one number of a motion by everything that the motion depends on, for the price of a few runs
// (docs/equations.md, "Adjoint and tracking").
#pragma once

#include <rom/integration/phase_equations.h>
#include <rom/integration/stored_motion.h>
#include <rom/sensitivity/motion_functional.h>

#include <string>

namespace swimtwin
{
  struct AdjointOptions
  {
    double relative_tolerance = 1e-6; ///< of the motion, as in IntegratorOptions
    double max_step_periods   = 0.05;
    long   max_steps          = 200'000;
    /// Steps of the motion that the adjoint takes as one, of order 5: its error follows the motion's tolerance.
    int steps_per_piece = 5;
  };

  /// Value and derivatives (SI) of a functional.
  struct MotionGradient
  {
    RunStatus   status = RunStatus::not_run;
    std::string failure; ///< one sentence

    double            value = 0.;
    Eigen::VectorXd   by_field;          ///< the field's parameters
    double            by_frequency = 0.; ///< at fixed phase: the field of the same shape, played faster
    SwimmerParameters by_parameters;
    Eigen::VectorXd   by_initial_state; ///< r + 3
    int               n_steps = 0, n_pieces = 0;

    bool completed() const { return status == RunStatus::completed; }
    /// By one parameter of those that runs can be differentiated by.
    double by(const Parameter &parameter) const;
  };

  /// The motion forwards by CVODES, then its adjoint backwards by collocation on pieces of several steps, with the
  /// integrals over parameters by the same rule: a field that has few parameters at a time costs no more with many.
  /// (CVODES' own adjoint needs several times as many steps back as forth here: its interpolated motion is not smooth.)
  /// Set up once, run often; one thread each.
  class AdjointIntegrator
  {
  public:
    /// `swimmer` must live as long.
    explicit AdjointIntegrator(const ReducedSwimmer &swimmer, const AdjointOptions &options = {});

    /// A run of the request with its functional and all derivatives. Throws InputError for values that are not
    /// possible.
    MotionGradient differentiate(const RunRequest &request, const MotionFunctional &functional);
    /// The functional's value alone.
    MotionGradient evaluate(const RunRequest &request, const MotionFunctional &functional);
    /// The motion of the last call.
    const StoredMotion &motion() const { return motion_; }
    double              length_m() const { return equations_.swimmer().length_m(); }

  private:
    /// Of the adjoint's steps, from the start to the end.
    std::vector<double> pieces();
    /// Phase of the field's last kink before the end; 0 without one.
    double last_kink() const;
    bool   go_forward(const RunRequest &request, const MotionFunctional &functional);
    void   go_back(const RunRequest &request, const MotionFunctional &functional);

    AdjointOptions      options_;
    PhaseEquations      equations_;
    MotionStore         store_;
    StoredMotion        motion_;
    std::vector<double> pieces_;
    MotionGradient      result_;
  };
} // namespace swimtwin
