// One step of the swimmer with its exact derivatives: the collocation of Radau IIA, order 5, stable for stiff shapes.
#pragma once

#include <rom/integration/radau_rule.h>
#include <rom/swimmer/reduced_swimmer.h>
#include <twin/motion/field_signal.h>

#include <array>

namespace swimtwin
{
  /// Parameters that a step is differentiated by, as columns.
  enum StepParameter {
    log_stiffness,     ///< E
    log_magnetization, ///< of head and tail
    background_x,      ///< T, added to the field
    background_y,
    n_step_parameters
  };

  /// The derivatives are those of the discrete step, to the tolerance of its Newton iteration. Nothing is allocated by
  /// a step. Belongs to one thread.
  class StateTransition
  {
  public:
    /// `swimmer` must live as long.
    explicit StateTransition(const ReducedSwimmer &swimmer);

    /// The state goes from one instant to the next; false if Newton's method does not converge, and the state stays.
    bool advance(const FieldSignal &field, double from_s, double to_s, const SwimmerParameters &parameters,
                 const Eigen::Vector2d &background_T, SwimmerState &state);

    /// Of the state after the last step, by the state before it (n x n) and by StepParameter (n x 4).
    const Eigen::MatrixXd &by_start() const { return by_start_; }
    const Eigen::MatrixXd &by_parameters() const { return by_parameters_; }

  private:
    static constexpr int n_stages = RadauRule::n_stages;
    static constexpr int max_size = n_stages * (2 * max_velocities - 1); ///< with inertia, and with the height
    using StageMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_size, max_size>;
    using StageVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_size, 1>;

    void   evaluate_stages(const SwimmerState &start, const SwimmerParameters &parameters, bool with_slopes);
    void   set_matrix(double length, bool at_start);
    void   guess_increments(double length, const SwimmerState &start, const SwimmerParameters &parameters);
    double correct_increments(double length);
    bool   solve_stages(double length, const SwimmerState &start, const SwimmerParameters &parameters);
    void   set_derivatives(double length, const SwimmerParameters &parameters);

    const ReducedSwimmer &swimmer_;
    Eigen::Index          n_, k_, free_; ///< states; those on which all depends; those on which nothing does
    RadauRule             rule_;

    SwimmerMotion                         motion_;
    std::array<RateDerivatives, n_stages> stages_;
    std::array<Eigen::Vector2d, n_stages> fields_T_;
    Eigen::Vector2d                       start_field_T_;
    StageVector                           increments_, correction_;
    StageMatrix                           matrix_;
    Eigen::PartialPivLU<StageMatrix>      factors_;
    Eigen::MatrixXd                       loads_;  ///< by the start, then by parameters
    Eigen::MatrixXd                       inputs_; ///< n x 4, of one stage
    Eigen::MatrixXd                       by_start_, by_parameters_;
    Eigen::VectorXd                       scale_;
  };
} // namespace swimtwin
