#include <rom/sensitivity/drift_gradient.h>

#include <rom/sensitivity/period_start.h>
#include <rom/swimmer/area_constraint.h>
#include <rom/swimmer/dense_algebra.h>

namespace swimtwin
{
  namespace
  {
    /// weights . state at the end.
    class LinearFunctional : public MotionFunctional
    {
    public:
      explicit LinearFunctional(Eigen::VectorXd weights) : weights_(std::move(weights)) {}

      double terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const override { return weights_.dot(state); }
      void   add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd>   &/*state*/,
                                   Eigen::Ref<Eigen::VectorXd> by_state) const override
      {
        by_state += weights_;
      }

    private:
      Eigen::VectorXd weights_;
    };

    /// The adjoint of what a period maps that returns to itself, (I - M^T) mu = (d drift / d start)^T direction, behind
    /// the direction itself.
    Eigen::VectorXd periodic_adjoint(const ReducedSwimmer &swimmer, const RunRequest &period, const Eigen::MatrixXd &S,
                                     const Eigen::Vector2d &direction)
    {
      const Eigen::VectorXd scale = start_units(swimmer, period.drive.frequency_Hz);
      const Eigen::Index    n     = scale.size();
      const Eigen::MatrixXd M     = scale.cwiseInverse().asDiagonal() * S.bottomRows(n) * scale.asDiagonal();
      const Eigen::VectorXd d     = scale.asDiagonal() * S.topRows(2).transpose() * direction;
      const Eigen::MatrixXd Z     = free_directions(swimmer, period.initial_state);
      const Eigen::MatrixXd A     = Z.transpose() * (Eigen::MatrixXd::Identity(n, n) - M) * Z;
      const Eigen::VectorXd mu    = Z * solve_by_qr<Eigen::VectorXd>(A.transpose(), Z.transpose() * d);
      Eigen::VectorXd       weights(n + 2);
      weights << direction, scale.cwiseInverse().cwiseProduct(mu);
      return weights;
    }
  } // namespace

  MotionGradient differentiate_drift(const ReducedSwimmer &swimmer, const RunRequest &request,
                                     const PeriodicOrbit &orbit, const Eigen::Vector2d &direction,
                                     const AdjointOptions &options)
  {
    RunRequest period         = request;
    period.initial_state      = orbit.start;
    period.n_periods          = 1;
    period.samples_per_period = 0;
    SwimmerIntegrator integrator(
        swimmer, {.relative_tolerance = options.relative_tolerance, .sensitivities = start_parameters(swimmer)});
    const SwimmerRun run = integrator.run(period);
    MotionGradient   result;
    result.status  = run.status;
    result.failure = run.failure;
    if (!run.completed())
      return result;
    const LinearFunctional functional(
        periodic_adjoint(swimmer, period, run.sensitivity_at_period_end.back(), direction));
    result       = AdjointIntegrator(swimmer, options).differentiate(period, functional);
    result.value = direction.dot(run.at_period_end.back().head<2>());
    result.by_initial_state.setZero();
    return result;
  }
} // namespace swimtwin
