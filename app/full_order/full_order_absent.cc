// The online build and its tests: everything that would run the full-order model says that it is not there.
#include <app/full_order/field_replay.h>
#include <app/full_order/flow_output.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/full_order_laboratory.h>
#include <app/full_order/full_order_plant.h>
#include <app/full_order/full_order_run.h>
#include <app/full_order/model_refinement.h>
#include <datasets/system/error.h>

namespace swimtwin
{
  void require_full_order_model(const std::string &option, RanksAtWork /*ranks*/)
  {
    throw InputError(option + " needs the full-order model, which this build is without: use the tool of the release "
                              "build, or leave the option out");
  }

  std::vector<PlaneFlow> write_flow_of_run(const Scene &, const ReducedModel &, const RunRequest &,
                                           const std::vector<ReducedSnapshot> &, const std::filesystem::path &,
                                           const std::function<void(int)> &)
  {
    require_full_order_model("a flow", RanksAtWork::this_one);
    return {};
  }

  double full_order_displacement_m(const Scene &, const std::filesystem::path &)
  {
    require_full_order_model("a full-order run", RanksAtWork::this_one);
    return 0.;
  }

  std::unique_ptr<FullOrderPlant> make_full_order_plant(const ReducedModel &, const FullOrderPlantOptions &)
  {
    require_full_order_model("[loop] plant = \"full-order\"", RanksAtWork::this_one);
    return {};
  }

  std::unique_ptr<LaboratorySwimmer> make_full_order_laboratory_swimmer(const Scene &, const LabConfig &,
                                                                        const FieldSignal &)
  {
    require_full_order_model("a full-order laboratory", RanksAtWork::this_one);
    return {};
  }

  RefinedModel refine_model(const RefinedModel &, const std::vector<std::filesystem::path> &, const InertiaTerms &,
                            const CommonOptions &, int)
  {
    require_full_order_model("--refine", RanksAtWork::all);
    return {};
  }

  PlanReplay replay_on_full_order_model(const ReducedModel &, const PlanResult &, const CommonOptions &,
                                        const ReplayOptions &)
  {
    require_full_order_model("a replay", RanksAtWork::this_one);
    return {};
  }
} // namespace swimtwin
