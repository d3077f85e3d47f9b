#include <app/frame/verb.h>

#include <app/frame/shipped_files.h>

namespace swimtwin
{
  namespace
  {
    /// What is wrong with the text behind --set, or nothing.
    std::string is_assignment(const std::string &text)
    {
      const auto sign = text.find('=');
      if (sign == 0 || sign == std::string::npos || sign + 1 == text.size())
        return text + " is not KEY=VALUE; write for instance --set time.periods=2";
      return {};
    }
  } // namespace

  void add_common_options(CLI::App &verb, CommonOptions &options, const OutputFolder output)
  {
    verb.add_option("--set", options.overrides, "Override a scene entry: key.path=value (repeatable)")
        ->type_name("KEY=VALUE")
        ->check(is_assignment)
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
