#include <app/verb.h>

#include <app/shipped_files.h>

namespace swimtwin
{
  void add_common_options(CLI::App &verb, CommonOptions &options, const OutputFolder output)
  {
    verb.add_option("--set", options.overrides, "Override a scene entry: key.path=value (repeatable)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    add_output_options(verb, options, output);
  }

  void add_output_options(CLI::App &verb, CommonOptions &options, const OutputFolder output)
  {
    auto *folder = verb.add_option("--output", options.output, "Folder for the results; nothing is written elsewhere")
                       ->type_name("DIR")
                       ->take_last();
    if (output == OutputFolder::required)
      folder->required();
    verb.add_flag("--force", options.force, "Replace results that are already there");
    verb.add_flag("--quiet", options.quiet, "Print errors only");
  }

  Scene load_scene(const CommonOptions &options)
  {
    return read_scene(find_scene(options.scene), options.overrides);
  }
} // namespace swimtwin
