// The tool: whatever needs the full-order model goes on in the program that has it.
#include <app/full_order/field_replay.h>
#include <app/full_order/flow_output.h>
#include <app/full_order/full_order_build.h>
#include <app/full_order/full_order_laboratory.h>
#include <app/full_order/full_order_plant.h>
#include <app/full_order/full_order_program.h>
#include <app/full_order/full_order_run.h>
#include <app/full_order/model_refinement.h>
#include <app/full_order/plan_report.h>
#include <app/full_order/resistance_report.h>
#include <app/full_order/simulation_report.h>
#include <app/full_order/training_report.h>

namespace swimtwin
{
  void require_full_order_model(const std::string & /*option*/, const RanksAtWork ranks)
  {
    continue_in_full_order_program(ranks);
  }

  void plan_and_report(const Scene &, const CommonOptions &)
  {
    continue_in_full_order_program(RanksAtWork::all);
  }

  void simulate_and_report(const Scene &, const CommonOptions &, const SimulateOptions &)
  {
    continue_in_full_order_program(RanksAtWork::all);
  }

  void resistance_and_report(const Scene &, const CommonOptions &)
  {
    continue_in_full_order_program(RanksAtWork::all);
  }

  void train_and_report(const Scene &, TrainCommand &)
  {
    continue_in_full_order_program(RanksAtWork::all);
  }

  RefinedModel refine_model(const RefinedModel &, const std::vector<std::filesystem::path> &, const InertiaTerms &,
                            const CommonOptions &, int)
  {
    continue_in_full_order_program(RanksAtWork::all);
  }

  PlanReplay replay_on_full_order_model(const ReducedModel &, const PlanResult &, const CommonOptions &,
                                        const ReplayOptions &)
  {
    continue_in_full_order_program(RanksAtWork::all);
  }

  std::vector<PlaneFlow> write_flow_of_run(const Scene &, const ReducedModel &, const RunRequest &,
                                           const std::vector<ReducedSnapshot> &, const std::filesystem::path &,
                                           const std::function<void(int)> &)
  {
    continue_in_full_order_program(RanksAtWork::this_one);
  }

  double full_order_displacement_m(const Scene &, const std::filesystem::path &)
  {
    continue_in_full_order_program(RanksAtWork::this_one);
  }

  std::unique_ptr<LaboratorySwimmer> make_full_order_laboratory_swimmer(const Scene &, const LabConfig &,
                                                                        const FieldSignal &)
  {
    continue_in_full_order_program(RanksAtWork::this_one);
  }

  std::unique_ptr<FullOrderPlant> make_full_order_plant(const ReducedModel &, const FullOrderPlantOptions &)
  {
    continue_in_full_order_program(RanksAtWork::this_one);
  }
} // namespace swimtwin
