// What all verbs share: their common options and how scenes and models are found.
#pragma once

#include <app/frame/ranks.h>
#include <datasets/scene/scene.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Options of every verb that reads a scene and writes a folder.
  struct CommonOptions
  {
    std::string              scene; ///< a file, or the name of a shipped scene
    std::filesystem::path    output;
    std::vector<std::string> overrides;
    bool                     force = false, quiet = false;
    std::string              command_line;
  };

  enum class OutputFolder { required, optional };

  void add_common_options(CLI::App &verb, CommonOptions &options, OutputFolder output);

  /// The same without --set, for a verb that reads no scene.
  void add_output_options(CLI::App &verb, CommonOptions &options, OutputFolder output);

  /// The scene of the options, with its overrides. Throws InputError.
  Scene load_scene(const CommonOptions &options);

  // Each verb adds itself to the tool and returns its work, to be called if the user chose it.
  using Work = std::function<void()>;
  Work add_plan(CLI::App &tool, const std::string &command_line);
  Work add_simulate(CLI::App &tool, const std::string &command_line);
  Work add_resistance(CLI::App &tool, const std::string &command_line);
  Work add_train(CLI::App &tool, const std::string &command_line);
  Work add_calibrate(CLI::App &tool, const std::string &command_line);
  Work add_sweep(CLI::App &tool, const std::string &command_line);
  Work add_reconstruct(CLI::App &tool, const std::string &command_line);
  Work add_optimize(CLI::App &tool, const std::string &command_line);
  Work add_track(CLI::App &tool, const std::string &command_line);
  Work add_lab(CLI::App &tool, const std::string &command_line);
  Work add_twin(CLI::App &tool, const std::string &command_line);
  Work add_report(CLI::App &tool, const std::string &command_line);
  Work add_demo(CLI::App &tool, const std::string &command_line);
} // namespace swimtwin
