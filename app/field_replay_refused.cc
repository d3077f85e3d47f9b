// The online build has no full-order model.
#include <app/field_replay.h>
#include <datasets/error.h>

namespace swimtwin
{
  void require_full_order_model()
  {
    throw InputError(
        "--replay needs the full-order model, which this build is without; use the release build, or leave "
        "the option out.");
  }

  PlanReplay replay_on_full_order_model(const ReducedModel &, const PlanResult &, const CommonOptions &,
                                        const ReplayOptions &)
  {
    require_full_order_model();
    return {};
  }
} // namespace swimtwin
