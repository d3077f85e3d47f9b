// Verb simulate: one run of the full-order model.
#include <app/full_order/simulation_report.h>

#include <memory>

namespace swimtwin
{
  Work add_simulate(CLI::App &tool, const std::string &command_line)
  {
    auto  common = std::make_shared<CommonOptions>();
    auto  own    = std::make_shared<SimulateOptions>();
    auto *verb   = tool.add_subcommand("simulate", "Run the full-order model on a scene");
    verb->add_option("scene", common->scene, "Scene file, or name of a shipped scene")->required();
    add_common_options(*verb, *common, OutputFolder::required);
    verb->add_flag("--resume", own->resume, "Go on from the last checkpoint of an interrupted run");
    verb->add_flag("--pictures", own->pictures,
                   "Draw trajectory, angles, stroke loop, power balance, shapes and flow, in space also the swimmer");
    common->command_line = command_line;
    return [common, own] {
      const Scene scene = load_scene(*common);
      simulate_and_report(scene, *common, *own);
    };
  }
} // namespace swimtwin
