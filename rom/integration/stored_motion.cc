#include <rom/integration/phase_integrator.h>
#include <rom/integration/stored_motion.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  Eigen::VectorXd StoredMotion::state_at(const double phase) const
  {
    if (steps_.empty())
      return start_;
    auto step = std::lower_bound(steps_.begin(), steps_.end(), phase,
                                 [](const Step &s, const double wanted) { return s.end < wanted; });
    if (step == steps_.end())
      --step;
    const Eigen::MatrixXd &c      = step->coefficients;
    const double           s      = phase - step->end;
    Eigen::VectorXd        result = c.col(c.cols() - 1);
    for (Eigen::Index k = c.cols() - 2; k >= 0; --k)
      result = c.col(k) + s * result;
    return result;
  }

  SwimmerState StoredMotion::end() const
  {
    return steps_.empty() ? SwimmerState(start_) : SwimmerState(steps_.back().coefficients.col(0));
  }

  MotionStore::MotionStore(const ReducedSwimmer &swimmer, const IntegratorOptions &options)
      : integrator_(std::make_unique<PhaseIntegrator>(swimmer, options))
  {
  }

  MotionStore::~MotionStore()                       = default;
  MotionStore::MotionStore(MotionStore &&) noexcept = default;

  namespace
  {
    /// Kinks of a periodic field over all periods, and the end.
    std::vector<double> stops(const RunRequest &request)
    {
      constexpr double    round_off = 1e-12;
      std::vector<double> phases;
      for (int period = 0; period < request.n_periods; ++period)
        for (const double kink : request.drive.field->kinks())
          if (period + kink > round_off)
            phases.push_back(period + kink);
      phases.push_back(request.n_periods);
      return phases;
    }
  } // namespace

  StoredMotion MotionStore::run(const RunRequest &request)
  {
    StoredMotion motion;
    integrator_->start(request);
    motion.start_ = request.initial_state;
    motion.status = RunStatus::completed;
    for (const double stop : stops(request))
      while (integrator_->phase() < stop)
      {
        if (!integrator_->advance_one_step(stop))
        {
          motion.status  = RunStatus::failed;
          motion.failure = fmt::format("the reduced swimmer stopped {:.4g} periods after its start: {}",
                                       integrator_->phase(), integrator_->failure());
          return motion;
        }
        motion.steps_.push_back(
            {integrator_->phase(), integrator_->taylor_coefficients(), integrator_->phase() == stop});
      }
    return motion;
  }
} // namespace swimtwin
