#include <app/frame/shipped_files.h>

#include <datasets/reduced/training_folder.h>
#include <datasets/system/error.h>
#include <datasets/system/nearest_name.h>

#include <fmt/format.h>

#include <string>
#include <vector>

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

    /// "; the nearest name that is shipped is open-2d", if one is close.
    std::string hint(const std::string &name, const fs::path &folder, const char *extension)
    {
      std::error_code          ignored;
      std::vector<std::string> shipped;
      for (const auto &entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == extension)
          shipped.push_back(entry.path().stem().string());
      const auto near = close_name(name, shipped);
      return near ? fmt::format("; the nearest name that is shipped is {}", *near) : "";
    }

    /// What is named may be a file here too, but for its ending.
    void refuse_two_meanings(const std::string &name, const fs::path &here, const fs::path &shipped)
    {
      std::error_code ignored;
      if (fs::is_regular_file(here, ignored) && !fs::equivalent(here, shipped, ignored))
        throw InputError(fmt::format("{} is shipped, and {} lies here too; say which is meant, {} or {}.", name,
                                     here.string(), here.string(), shipped.string()));
    }

    /// A file as it is named, or the shipped one of that name. A name with a folder means what is in that folder.
    fs::path file_or_shipped(const std::string &name, const char *folder, const char *extension)
    {
      std::error_code ignored;
      const fs::path  shipped    = shipped_datasets() / folder / (name + extension);
      const bool      is_shipped = !fs::path(name).has_parent_path() && fs::exists(shipped, ignored);
      if (fs::exists(name, ignored) && !(fs::is_directory(name, ignored) && is_shipped))
        return name;
      if (is_shipped)
      {
        refuse_two_meanings(name, name + extension, shipped);
        return shipped;
      }
      const bool is_plain = fs::path(name).filename() == name && !fs::path(name).has_extension();
      if (const std::string near = is_plain ? hint(name, shipped.parent_path(), extension) : ""; !near.empty())
        throw InputError(fmt::format("cannot read {}: there is no such file{}.", name, near));
      return name;
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
    fs::path file = file_or_shipped(model, "models", ".h5");
    if (holds_training(file))
      file /= trained_model_name;
    if (const fs::path folder = file.parent_path();
        !is_there(file) && file.filename() == trained_model_name && holds_training(folder))
      throw InputError(fmt::format("{} is not there: the training in {} has not ended; let it end, or go on with "
                                   "`swimtwin train SCENE --output {} --resume`.",
                                   file.string(), folder.string(), folder.string()));
    return file;
  }

  bool is_model(const std::string &name)
  {
    return name.ends_with(".h5") || fs::exists(shipped_file("models/" + name + ".h5"));
  }
} // namespace swimtwin
