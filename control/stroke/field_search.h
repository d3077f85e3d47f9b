// Searches for a periodic field, from one start or many, and what they cost.
#pragma once

#include <control/stroke/stroke_problem.h>
#include <datasets/run/plan_result.h>
#include <optimization/guarded_search.h>

#include <functional>

namespace swimtwin
{
  struct FieldSearchOptions
  {
    SearchOptions search      = {.method                = SearchMethod::slsqp,
                                 .max_evaluations       = 200,
                                 .step_tolerance        = 1e-6,
                                 .kkt_tolerance         = 1e-3,
                                 .feasibility_tolerance = 1e-5};
    StrokeOptions stroke      = {};
    long          max_periods = 0; ///< integrated; 0: no bound but that on evaluations
    int           n_threads   = 0; ///< 0: as many as the machine has
  };

  /// Where a search begins: a field, and a state near its periodic motion.
  struct FieldStart
  {
    Drive        drive;
    SwimmerState state;
  };

  struct FieldFound
  {
    Minimum                    minimum;
    Drive                      drive;
    SwimmerState               start; ///< of its periodic motion
    long                       n_periods = 0;
    std::vector<PlanTraceStep> trace;
  };

  /// What does not change during a plan.
  struct FieldTask
  {
    const ReducedModel   &model;
    const ReducedSwimmer &swimmer;
    const SwimmingGoal   &goal;
    TermSizes             sizes;
  };

  /// The same answer for the same start, whatever was searched before.
  FieldFound search_field(const FieldTask &task, const FieldVariables &variables, const FieldStart &start,
                          const FieldSearchOptions &options);

  /// One search per start, on some threads; results in the order of the starts.
  std::vector<FieldFound> search_fields(const FieldTask &task, const FieldVariables &variables,
                                        const std::vector<FieldStart> &starts, const FieldSearchOptions &options);
  /// The lowest feasible one; without one, the nearest to being feasible. Throws if there are none.
  const FieldFound &best_of(const std::vector<FieldFound> &found);

  /// Sobol points around a field: each variable within `part` of its range, the frequency anywhere.
  std::vector<FieldStart> starts_around(const FieldStart &centre, const FieldVariables &variables,
                                        const SwimmingGoal &goal, int n_starts, double part, unsigned long seed);
} // namespace swimtwin
