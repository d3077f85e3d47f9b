#include <app/verb.h>

#include <datasets/error.h>

#include <mpi.h>

namespace swimtwin
{
  namespace
  {
    /// Folder of the shipped scenes: beside the sources that this tool was built from, wherever they are now.
    std::filesystem::path shipped_scenes()
    {
      std::error_code             error;
      const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", error);
      if (const auto beside = tool.parent_path() / "../../datasets/scenes";
          !error && std::filesystem::is_directory(beside))
        return std::filesystem::weakly_canonical(beside);
      return SWIMTWIN_SCENES;
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
    std::filesystem::path file = options.scene;
    if (const auto shipped = shipped_scenes() / (options.scene + ".toml");
        !std::filesystem::exists(file) && std::filesystem::exists(shipped))
      file = shipped;
    return read_scene(file, options.overrides);
  }

  bool is_speaker()
  {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == 0;
  }
} // namespace swimtwin
