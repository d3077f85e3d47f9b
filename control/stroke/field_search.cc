#include <control/stroke/cost_record.h>
#include <control/stroke/field_search.h>
#include <datasets/system/parallel_for.h>
#include <optimization/sobol_points.h>

#include <algorithm>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr const char *budget_is_spent = "the budget of periods is spent";
  }

  FieldFound search_field(const FieldTask &task, const FieldVariables &variables, const FieldStart &start,
                          const FieldSearchOptions &options)
  {
    StrokeProblem strokes(task.model, task.swimmer, task.goal, variables, options.stroke);
    const auto    is_spent = [&] { return options.max_periods > 0 && strokes.n_periods() >= options.max_periods; };
    strokes.restart_from(start.state);
    CostRecord          record(options.search.feasibility_tolerance);
    SwimmerState        best_start = start.state;
    MinimizationProblem problem    = field_box(variables, task.goal);
    problem.n_constraints          = strokes.n_constraints();
    problem.constraint_scale       = Eigen::VectorXd::Ones(problem.n_constraints); // all are relative to their limits
    problem.constraint_names       = strokes.constraint_names();
    problem.evaluate               = [&](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
      if (is_spent())
      {
        evaluation.failure = budget_is_spent;
        return;
      }
      strokes.evaluate(x, derivatives, task.sizes, evaluation);
      // A search may miss a constraint by its tolerance; the field must not miss its limit.
      evaluation.constraints.array() += options.search.feasibility_tolerance;
      if (record.note(evaluation, strokes.n_periods()))
        best_start = strokes.stroke(x, false).orbit.start; // that one again, not another motion in the same field
      // Steps without gradients are wide: the motion of a bad one may be another's start, and lead to a third.
      if (!uses_gradients(options.search.method))
        strokes.restart_from(best_start);
    };
    FieldFound found;
    found.minimum = search_minimum(problem, variables.variables(start.drive), options.search);
    if (is_spent() && found.minimum.status == MinimumStatus::stalled) // it met the end of its budget as a failure
    {
      found.minimum.status  = MinimumStatus::budget_exhausted;
      found.minimum.message = budget_is_spent;
    }
    found.n_periods = strokes.n_periods();
    found.trace     = record.trace();
    found.start     = start.state;
    if (found.minimum.x.size() == 0)
      return found;
    found.drive = variables.drive(found.minimum.x);
    strokes.restart_from(best_start);
    if (const Stroke &stroke = strokes.stroke(found.minimum.x, false); stroke.found())
      found.start = stroke.orbit.start;
    return found;
  }

  std::vector<FieldFound> search_fields(const FieldTask &task, const FieldVariables &variables,
                                        const std::vector<FieldStart> &starts, const FieldSearchOptions &options)
  {
    std::vector<FieldFound> found(starts.size());
    parallel_for(starts.size(), n_threads_for(starts.size(), options.n_threads), [&] {
      return [&](const std::size_t i) { found[i] = search_field(task, variables, starts[i], options); };
    });
    return found;
  }

  const FieldFound &best_of(const std::vector<FieldFound> &found)
  {
    const auto rank = [](const FieldFound &f) {
      if (f.minimum.is_feasible())
        return std::pair(0, f.minimum.objective);
      return f.minimum.status == MinimumStatus::infeasible ? std::pair(1, f.minimum.violation)
                                                           : std::pair(2, std::numeric_limits<double>::infinity());
    };
    return *std::min_element(found.begin(), found.end(),
                             [&](const FieldFound &a, const FieldFound &b) { return rank(a) < rank(b); });
  }

  std::vector<FieldStart> starts_around(const FieldStart &centre, const FieldVariables &variables,
                                        const SwimmingGoal &goal, const int n_starts, const double part,
                                        const unsigned long seed)
  {
    const MinimizationProblem box = field_box(variables, goal);
    const Eigen::VectorXd     x = variables.variables(centre.drive), range = part * (box.upper - box.lower);
    Eigen::VectorXd           lower = (x - range).cwiseMax(box.lower), upper = (x + range).cwiseMin(box.upper);
    const Eigen::Index        last = x.size() - 1;
    lower[last]                    = box.lower[last];
    upper[last]                    = box.upper[last];
    const Eigen::MatrixXd   points = sobol_points(lower, upper, n_starts, seed);
    std::vector<FieldStart> starts;
    for (int i = 0; i < n_starts; ++i)
      starts.push_back({variables.drive(points.col(i)), centre.state});
    return starts;
  }
} // namespace swimtwin
