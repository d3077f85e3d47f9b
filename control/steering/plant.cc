#include <control/steering/plant.h>
#include <datasets/system/error.h>

namespace swimtwin
{
  ReducedPlant::ReducedPlant(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters,
                             const SwimmerState &state, const double relative_tolerance)
      : swimmer_(swimmer), parameters_(parameters), state_(state), relative_tolerance_(relative_tolerance)
  {
  }

  void ReducedPlant::advance(const SteeringPlan &plan, const double from, const double to)
  {
    const double       length = to - from;
    MotionStore        store(swimmer_, {.relative_tolerance = relative_tolerance_,
                                        .max_step_periods   = IntegratorOptions().max_step_periods / length});
    const StoredMotion motion = store.run({parameters_, window_of(plan, from, length), state_, 1, 0});
    if (!motion.completed())
      throw ComputationError(motion.failure);
    state_ = motion.end();
  }
} // namespace swimtwin
