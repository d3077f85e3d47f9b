// Verb plan: what will be solved, what is skipped and why, and what it will cost. Meshes, but solves nothing.
#include <app/full_order/plan_report.h>

#include <memory>

namespace swimtwin
{
  Work add_plan(CLI::App &tool, const std::string &command_line)
  {
    auto  common = std::make_shared<CommonOptions>();
    auto *verb   = tool.add_subcommand("plan", "Say what a run would solve, skip and cost; run nothing");
    verb->add_option("scene", common->scene, "Scene file, or name of a shipped scene")->required();
    add_common_options(*verb, *common, OutputFolder::optional);
    common->command_line = command_line;
    return [common] { plan_and_report(load_scene(*common), *common); };
  }
} // namespace swimtwin
