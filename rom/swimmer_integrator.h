// Time integration of the reduced swimmer with sensitivities: CVODES, BDF, dense, analytic Jacobian.
#pragma once

#include <rom/reduced_swimmer.h>
#include <rom/swimmer_run.h>

#include <memory>

namespace swimtwin
{
  struct IntegratorOptions
  {
    /// Local error per step. Absolute tolerances are this in rad, and times a stroke (0.03 body lengths) for lengths.
    double                 relative_tolerance = 1e-6;
    double                 max_step_periods   = 0.05;
    long                   max_steps          = 200'000; ///< per run
    bool                   with_work          = false;   ///< integrate magnetic work and dissipation too
    std::vector<Parameter> sensitivities      = {};      ///< the state's derivatives by these are integrated with it
    bool control_sensitivity_errors = true; ///< like the state's; without, they are as good as the state's steps
  };

  /// Set up once, run often: nothing is allocated between runs, and a run does not depend on those before it. One
  /// thread each. The equations are integrated in phase, d state / d phase = rate / frequency, so that derivatives by
  /// the frequency are those at fixed phase.
  class SwimmerIntegrator
  {
  public:
    /// `swimmer` must live as long. Throws InputError for a sensitivity that the swimmer does not have.
    SwimmerIntegrator(const ReducedSwimmer &swimmer, const IntegratorOptions &options);
    ~SwimmerIntegrator();
    SwimmerIntegrator(SwimmerIntegrator &&) noexcept;
    SwimmerIntegrator &operator=(SwimmerIntegrator &&) = delete;

    /// A failure of the integrator is a status of the result, whose periods before it are kept.
    SwimmerRun run(const RunRequest &request);

  private:
    class Memory;
    std::unique_ptr<Memory> memory_;
  };
} // namespace swimtwin
