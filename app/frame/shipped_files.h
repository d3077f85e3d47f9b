// What is shipped with the tool: scenes, models, data.
#pragma once

#include <filesystem>
#include <string>

namespace swimtwin
{
  /// A file that is shipped, by its place in datasets/.
  std::filesystem::path shipped_file(const std::string &place);
  /// A scene by its file, or by the name of a shipped one.
  std::filesystem::path find_scene(const std::string &scene);
  /// A reduced model by its file, by the folder of its training, or by the name of a shipped one. Throws InputError for
  /// a training that has not ended.
  std::filesystem::path find_model(const std::string &model);
  /// Whether a name is that of a model: a file that ends so, or a shipped one.
  bool is_model(const std::string &name);
} // namespace swimtwin
