// A plan's fields on the full-order model.
#pragma once

#include <app/frame/verb.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/run/plan_result.h>

namespace swimtwin
{
  struct ReplayOptions
  {
    int periods          = 3;
    int steps_per_period = 200;
  };

  /// Runs the tuned sinusoid and the optimal field of a plan from rest, straight, at the angle from which the motion
  /// settles fastest, the body's middle where the scene has it, on the axis of a channel; results go to folders of the
  /// output. Collective.
  PlanReplay replay_on_full_order_model(const ReducedModel &model, const PlanResult &plan, const CommonOptions &common,
                                        const ReplayOptions &options);
} // namespace swimtwin
