// A run whose state is known at every instant.
#pragma once

#include <rom/integration/integrator_options.h>
#include <rom/integration/swimmer_run.h>
#include <rom/swimmer/reduced_swimmer.h>

#include <memory>
#include <string>
#include <vector>

namespace swimtwin
{
  class PhaseIntegrator;

  /// The integrator's own polynomial of every step.
  class StoredMotion
  {
  public:
    RunStatus   status = RunStatus::not_run;
    std::string failure; ///< one sentence

    bool completed() const { return status == RunStatus::completed; }
    int  n_steps() const { return static_cast<int>(steps_.size()); }
    /// Phase at the end of a step; -1 is the start.
    double          end_of_step(int step) const { return step < 0 ? 0. : steps_[static_cast<std::size_t>(step)].end; }
    bool            ends_at_kink(int step) const { return steps_[static_cast<std::size_t>(step)].ends_at_kink; }
    Eigen::VectorXd state_at(double phase) const;
    SwimmerState    end() const;

  private:
    friend class MotionStore;
    struct Step
    {
      double          end = 0.;
      Eigen::MatrixXd coefficients; ///< column k times (phase - end)^k
      bool            ends_at_kink = false;
    };
    std::vector<Step> steps_;
    Eigen::VectorXd   start_;
  };

  /// Set up once, run often; one thread each.
  class MotionStore
  {
  public:
    /// Options' sensitivities and work are not for it. `swimmer` must live as long.
    MotionStore(const ReducedSwimmer &swimmer, const IntegratorOptions &options);
    ~MotionStore();
    MotionStore(MotionStore &&) noexcept;
    MotionStore &operator=(MotionStore &&) = delete;

    /// A failure of the integrator is a status of the result.
    StoredMotion run(const RunRequest &request);

  private:
    std::unique_ptr<PhaseIntegrator> integrator_; ///< stays where it is: CVODES holds its address
  };
} // namespace swimtwin
