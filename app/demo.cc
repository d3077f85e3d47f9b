// Verb demo: what the tool does, in about a minute.
#include <app/simulate.h>

#include <fmt/format.h>

#include <memory>

namespace swimtwin
{
  Work add_demo(CLI::App &tool, const std::string &command_line)
  {
    auto  common = std::make_shared<CommonOptions>();
    auto *verb   = tool.add_subcommand("demo", "Watch the reference study's swimmer swim for three periods");
    add_common_options(*verb, *common, OutputFolder::required);
    common->scene        = "reference-2d-casefile";
    common->command_line = command_line;
    return [common] {
      const Scene scene = load_scene(*common);
      if (is_speaker() && !common->quiet)
        fmt::print(
            "The reference study's elastic magneto-swimmer (scene {}): a rigid magnetic head of {} x {} mm pulls a\n"
            "tapered elastic tail of {} mm through glycerol, driven at {:.2g} Hz.\n",
            scene.name, 1e3 * scene.head.size_m[0], 1e3 * scene.head.size_m[1], 1e3 * scene.tail->length_m,
            1. / scene.time.period_s);
      SimulateOptions options;
      options.pictures = true;
      simulate_and_report(scene, *common, options);
    };
  }
} // namespace swimtwin
