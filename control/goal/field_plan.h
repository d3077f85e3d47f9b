// A plan: the best periodic field for a goal, and what it is measured against.
#pragma once

#include <control/stroke/field_search.h>

namespace swimtwin
{
  struct FieldPlanOptions
  {
    FieldSearchOptions search;
    int                n_starts = 3; ///< beside the continuation from the tuned sinusoid
    unsigned long      seed     = 1; ///< of the Sobol points
    /// A method without gradients gets this many times the periods that the best search with gradients took; 0: none.
    double               gradient_free_budget = 1.;
    SearchMethod         gradient_free        = SearchMethod::cobyla;
    std::optional<Drive> given;     ///< a field of the same number of harmonics to start from too
    std::vector<double>  trade_off; ///< bounds on the multiplier, to be planned for one after the other
    /// Told what comes next.
    std::function<void(const std::string &)> on_progress;
  };

  /// Fields, trade-off, members, warnings, status and message; `reference` is the scene's own field. Throws InputError
  /// for a goal whose limits do not bound the field.
  PlanResult plan_field(const ReducedModel &model, const SwimmingGoal &goal, const Drive &reference,
                        const FieldPlanOptions &options, const std::vector<SwimmerParameters> &members = {});
} // namespace swimtwin
