// One step back of the adjoint equations.
#pragma once

#include <rom/integration/radau_rule.h>
#include <rom/sensitivity/adjoint_integrator.h>

#include <array>

namespace swimtwin
{
  /// lambda' = -J^T lambda - (dl/dy)^T / f from the end of a piece to its start, and the piece's part of the
  /// derivatives by parameters. Belongs to one thread.
  class AdjointStep
  {
  public:
    AdjointStep(PhaseEquations &equations, const StoredMotion &motion, const MotionFunctional &functional);

    void take(double start, double end, Eigen::VectorXd &lambda, MotionGradient &gradient);

  private:
    static constexpr int n_stages = RadauRule::n_stages;
    /// What one instant of the piece contributes.
    struct Stage
    {
      double          phase = 0., running = 0.;
      Eigen::VectorXd running_by_state;
      Eigen::Vector2d running_by_field;
      RateDerivatives rate;
    };

    void set_stage(double phase, Stage &stage);
    void solve_stages(double length, const Eigen::VectorXd &lambda);
    void add_parameters(const Stage &stage, const Eigen::Ref<const Eigen::VectorXd> &lambda, double weight,
                        MotionGradient &gradient) const;

    PhaseEquations         &equations_;
    const StoredMotion     &motion_;
    const MotionFunctional &functional_;
    RadauRule               rule_;

    std::array<Stage, n_stages> stages_;
    Eigen::MatrixXd             matrix_;
    Eigen::VectorXd             lambdas_; ///< of all stages
  };
} // namespace swimtwin
