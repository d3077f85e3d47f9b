// The search for a periodic field as a minimisation problem.
#pragma once

#include <control/stroke/swimming_goal.h>
#include <optimization/minimization_problem.h>

#include <memory>

namespace swimtwin
{
  /// Sizes of the terms in the reference sinusoid: what weights are relative to.
  using TermSizes = std::map<StrokeTerm, double>;

  /// Objective and constraints of one swimmer, with their slopes by the variables of the field. Strokes start from the
  /// last one found: a search goes by small steps. Belongs to one thread.
  class StrokeProblem
  {
  public:
    StrokeProblem(const ReducedModel &model, const ReducedSwimmer &swimmer, const SwimmingGoal &goal,
                  const FieldVariables &variables, const StrokeOptions &options = {});

    const FieldVariables    &variables() const { return variables_; }
    int                      n_constraints() const { return limits_.size() + motion_.size(); }
    std::vector<std::string> constraint_names() const;
    const LimitedMotion     &motion_limits() const { return motion_; }

    /// The stroke at x; the last one is kept, and differentiated only when asked for.
    const Stroke &stroke(const Eigen::VectorXd &x, bool with_slopes);
    TermValue     term(StrokeTerm term, const Stroke &stroke) const;
    /// `objective` is minus the weighted gains plus the weighted costs.
    void evaluate(const Eigen::VectorXd &x, bool derivatives, const TermSizes &sizes, Evaluation &evaluation);

    long n_periods() const { return n_periods_; } ///< integrated so far: what an evaluation costs
    /// Where strokes start from until one is found.
    void restart_from(const SwimmerState &start);

  private:
    const SwimmingGoal   &goal_;
    FieldVariables        variables_;
    LimitedField          limits_;
    StrokeFinder          finder_;
    LimitedMotion         motion_;
    SwimmerState          rest_, start_;
    Eigen::VectorXd       last_x_;
    std::optional<Stroke> last_;
    long                  n_periods_ = 0;
  };

  /// Sizes of the goal's terms in a stroke. Throws ComputationError if one of them vanishes.
  TermSizes term_sizes(const StrokeProblem &problem, const SwimmingGoal &goal, const Stroke &reference);

  /// Bounds and scales of the variables: coefficients that |B| allows, frequencies of the goal.
  MinimizationProblem field_box(const FieldVariables &variables, const SwimmingGoal &goal);
} // namespace swimtwin
