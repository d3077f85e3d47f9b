// Time integration of the reduced swimmer with sensitivities: CVODES, BDF, dense, analytic Jacobian.
#pragma once

#include <rom/integration/integrator_options.h>
#include <rom/integration/swimmer_run.h>
#include <rom/swimmer/reduced_swimmer.h>

#include <memory>

namespace swimtwin
{
  class PhaseIntegrator;

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
    std::unique_ptr<PhaseIntegrator> integrator_; ///< stays where it is: CVODES holds its address
  };
} // namespace swimtwin
