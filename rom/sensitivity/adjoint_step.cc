#include <rom/sensitivity/adjoint_step.h>

#include <rom/swimmer/dense_algebra.h>

// Letters as in docs/equations.md, "Adjoint and tracking": y state, lambda its adjoint, J the derivative of dy/dphase
// by y, l the running part of the functional, f the frequency.

namespace swimtwin
{
  AdjointStep::AdjointStep(PhaseEquations &equations, const StoredMotion &motion, const MotionFunctional &functional)
      : equations_(equations), motion_(motion), functional_(functional), rule_(radau_rule())
  {
    const int n = equations.swimmer().n_states();
    matrix_.resize(n_stages * n, n_stages * n);
    lambdas_.resize(n_stages * n);
  }

  void AdjointStep::set_stage(const double phase, Stage &stage)
  {
    const Eigen::VectorXd state = motion_.state_at(phase);
    const MotionInstant   instant{phase, state, equations_.field_T(phase)};
    stage.phase            = phase;
    stage.running          = functional_.running(instant);
    stage.running_by_state = Eigen::VectorXd::Zero(state.size());
    InstantGradient gradient{stage.running_by_state};
    functional_.add_running_gradient(instant, gradient);
    stage.running_by_field = gradient.by_field;
    stage.rate             = equations_.derivatives(phase, state);
  }

  /// lambda_i = lambda + h sum_j A_ij (J_j^T lambda_j + (dl/dy)_j^T / f), backwards from the end.
  void AdjointStep::solve_stages(const double length, const Eigen::VectorXd &lambda)
  {
    const Eigen::Index n = lambda.size();
    const double       h = length / equations_.drive().frequency_Hz;
    matrix_.setIdentity();
    for (int i = 0; i < n_stages; ++i)
    {
      lambdas_.segment(i * n, n) = lambda;
      for (int j = 0; j < n_stages; ++j)
      {
        const Stage &stage = stages_[static_cast<std::size_t>(j)];
        matrix_.block(i * n, j * n, n, n) -= h * rule_.A(i, j) * stage.rate.by_state.transpose();
        lambdas_.segment(i * n, n) += h * rule_.A(i, j) * stage.running_by_state;
      }
    }
    lambdas_ = solve_by_lu(matrix_, lambdas_);
  }

  /// weight (lambda . dF/dp + dl/dp / f) for all parameters p.
  void AdjointStep::add_parameters(const Stage &stage, const Eigen::Ref<const Eigen::VectorXd> &lambda,
                                   const double weight, MotionGradient &gradient) const
  {
    const Drive           &drive = equations_.drive();
    const double           f = drive.frequency_Hz, w = weight / f;
    const RateDerivatives &d = stage.rate;
    gradient.value += w * stage.running;
    gradient.by_frequency -= w / f * (lambda.dot(d.rate) + stage.running);
    gradient.by_parameters.young_modulus_Pa += w * lambda.dot(d.by_young_modulus);
    gradient.by_parameters.viscosity_Pa_s += w * lambda.dot(d.by_viscosity);
    gradient.by_parameters.magnetization_A_m += w * lambda.dot(d.by_magnetization);
    gradient.by_parameters.tail_magnetization_A_m += w * lambda.dot(d.by_tail_magnetization);
    const Eigen::Vector2d by_field = w * (d.by_field.transpose() * lambda + stage.running_by_field);
    drive.field->pull_back(stage.phase, drive.parameters, by_field, gradient.by_field);
  }

  void AdjointStep::take(const double start, const double end, Eigen::VectorXd &lambda, MotionGradient &gradient)
  {
    const double       length = end - start;
    const Eigen::Index n      = lambda.size();
    for (int i = 0; i < n_stages; ++i)
      set_stage(end - rule_.c[i] * length, stages_[static_cast<std::size_t>(i)]);
    solve_stages(length, lambda);
    for (int i = 0; i < n_stages; ++i)
      add_parameters(stages_[static_cast<std::size_t>(i)], lambdas_.segment(i * n, n),
                     length * rule_.A(n_stages - 1, i), gradient);
    lambda = lambdas_.tail(n);
  }
} // namespace swimtwin
