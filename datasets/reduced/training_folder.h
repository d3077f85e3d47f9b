// What the folder of a training looks like to those who are given it.
#pragma once

#include <datasets/files/input_file.h>

#include <filesystem>

namespace swimtwin
{
  inline constexpr const char *trained_model_name = "model.h5"; ///< written last

  inline bool has_trained_model(const std::filesystem::path &folder)
  {
    return is_there(folder / trained_model_name);
  }

  /// Of one that has ended or has not.
  inline bool holds_training(const std::filesystem::path &folder)
  {
    return is_folder(folder / "runs/run-01") || has_trained_model(folder);
  }
} // namespace swimtwin
