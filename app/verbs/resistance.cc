// Verb resistance: the rigid resistance matrix of a scene's swimmer at rest.
#include <app/full_order/resistance_report.h>

#include <datasets/system/error.h>

#include <memory>

namespace swimtwin
{
  Work add_resistance(CLI::App &tool, const std::string &command_line)
  {
    auto  common = std::make_shared<CommonOptions>();
    auto *verb =
        tool.add_subcommand("resistance", "Hydrodynamic resistance matrix of a scene's swimmer, moved as a rigid body");
    verb->add_option("scene", common->scene, "Scene file, or name of a shipped scene")->required();
    add_common_options(*verb, *common, OutputFolder::required);
    common->command_line = command_line;
    return [common] {
      const Scene scene = load_scene(*common);
      if (!scene.fluid)
        throw InputError(scene.name + " has no [fluid]: a resistance matrix needs one; add [fluid] and [domain]");
      resistance_and_report(scene, *common);
    };
  }
} // namespace swimtwin
