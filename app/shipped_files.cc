#include <app/shipped_files.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
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

  fs::path shipped_file(const std::string &place)
  {
    return shipped_datasets() / place;
  }

  fs::path find_scene(const std::string &scene)
  {
    return file_or_shipped(scene, "scenes", ".toml");
  }

  fs::path find_model(const std::string &model)
  {
    return file_or_shipped(model, "models", ".h5");
  }
} // namespace swimtwin
