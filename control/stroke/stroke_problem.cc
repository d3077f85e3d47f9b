#include <control/stroke/stroke_problem.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    StrokeOptions with_parameters(StrokeOptions options, const FieldVariables &variables)
    {
      options.variables = variables.parameters();
      return options;
    }
  } // namespace

  StrokeProblem::StrokeProblem(const ReducedModel &model, const ReducedSwimmer &swimmer, const SwimmingGoal &goal,
                               const FieldVariables &variables, const StrokeOptions &options)
      : goal_(goal), variables_(variables), limits_(*variables.field(), goal.field),
        finder_(swimmer, with_parameters(options, variables)),
        motion_(model, swimmer, goal.motion, options, goal.heading_rad),
        rest_(state_at_rest(swimmer, goal.heading_rad)), start_(rest_)
  {
  }

  std::vector<std::string> StrokeProblem::constraint_names() const
  {
    std::vector<std::string> names = limits_.names();
    names.insert(names.end(), motion_.names().begin(), motion_.names().end());
    return names;
  }

  void StrokeProblem::restart_from(const SwimmerState &start)
  {
    start_ = start;
    last_.reset();
  }

  const Stroke &StrokeProblem::stroke(const Eigen::VectorXd &x, const bool with_slopes)
  {
    const bool known = last_ && last_x_ == x;
    if (known && (!with_slopes || !last_->found() || last_->slopes.drift_m.size() > 0))
      return *last_;
    RunRequest request{goal_.swimmer, variables_.drive(x), start_, 1, 0};
    last_   = finder_.find(request, with_slopes);
    last_x_ = x;
    n_periods_ += last_->n_periods;
    start_ = last_->found() ? last_->orbit.start : rest_;
    return *last_;
  }

  TermValue StrokeProblem::term(const StrokeTerm term, const Stroke &stroke) const
  {
    return swimtwin::evaluate(term, finder_.swimmer(), *variables_.field(), stroke, goal_.heading_rad);
  }

  void StrokeProblem::evaluate(const Eigen::VectorXd &x, const bool derivatives, const TermSizes &sizes,
                               Evaluation &evaluation)
  {
    if (!x.allFinite())
    {
      evaluation.failure = "the search left the numbers";
      return;
    }
    const Stroke &now  = stroke(x, derivatives);
    evaluation.failure = now.failure;
    if (!now.found())
      return;
    evaluation.objective = 0.;
    if (derivatives)
      evaluation.gradient = Eigen::VectorXd::Zero(variables_.size());
    for (const auto &[term, weight] : goal_.weights)
    {
      const TermValue part   = this->term(term, now);
      const double    factor = (is_gain(term) ? -weight : weight) / sizes.at(term);
      evaluation.objective += factor * part.value;
      if (derivatives)
        evaluation.gradient += factor * variables_.slopes(part.slopes).transpose();
    }
    const LimitValues field  = limits_.evaluate(variables_.coefficients(x), variables_.frequency_Hz(x));
    const LimitValues motion = motion_.evaluate(now);
    evaluation.constraints.resize(n_constraints());
    evaluation.constraints << field.values, motion.values;
    if (!derivatives)
      return;
    evaluation.jacobian.resize(n_constraints(), variables_.size());
    evaluation.jacobian << variables_.slopes(field.slopes), variables_.slopes(motion.slopes);
  }

  TermSizes term_sizes(const StrokeProblem &problem, const SwimmingGoal &goal, const Stroke &reference)
  {
    TermSizes sizes;
    for (const auto &[term, weight] : goal.weights)
    {
      sizes[term] = std::abs(problem.term(term, reference).value);
      if (!(sizes[term] > 0.))
        throw ComputationError(fmt::format(
            "{} vanishes in the reference sinusoid, so that no weight can be relative to it", to_string(term)));
    }
    return sizes;
  }

  MinimizationProblem field_box(const FieldVariables &variables, const SwimmingGoal &goal)
  {
    constexpr double    scale_part = 0.1; // of the range: the change that matters
    const int           n          = variables.size();
    const double        largest_T  = 4. / std::numbers::pi * largest_magnitude_T(goal.field); // of a square wave
    MinimizationProblem problem;
    problem.lower        = Eigen::VectorXd::Constant(n, -largest_T);
    problem.upper        = Eigen::VectorXd::Constant(n, largest_T);
    problem.scale        = Eigen::VectorXd::Constant(n, scale_part * largest_T);
    problem.lower[n - 1] = goal.frequency_Hz.low;
    problem.upper[n - 1] = goal.frequency_Hz.high;
    problem.scale[n - 1] =
        std::max(scale_part * (goal.frequency_Hz.high - goal.frequency_Hz.low), 1e-3 * goal.frequency_Hz.high);
    return problem;
  }
} // namespace swimtwin
