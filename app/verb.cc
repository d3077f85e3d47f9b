#include <app/verb.h>

#include <datasets/error.h>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Folder of what is shipped: beside the sources that this tool was built from, wherever they are now.
    fs::path shipped_datasets()
    {
      std::error_code error;
      const fs::path  tool = fs::read_symlink("/proc/self/exe", error);
      if (const auto beside = tool.parent_path() / "../../datasets"; !error && fs::is_directory(beside))
        return fs::weakly_canonical(beside);
      return SWIMTWIN_DATASETS;
    }

    /// A file as it is named, or the shipped one of that name.
    fs::path file_or_shipped(const std::string &name, const char *folder, const char *extension)
    {
      const fs::path shipped = shipped_datasets() / folder / (name + extension);
      return !fs::is_regular_file(name) && fs::exists(shipped) ? shipped : fs::path(name);
    }
  } // namespace

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
    return read_scene(file_or_shipped(options.scene, "scenes", ".toml"), options.overrides);
  }

  std::filesystem::path shipped_file(const std::string &place)
  {
    return shipped_datasets() / place;
  }

  std::filesystem::path find_model(const std::string &model)
  {
    return file_or_shipped(model, "models", ".h5");
  }
} // namespace swimtwin
