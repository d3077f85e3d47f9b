// Work in a folder of its own: the frame of every verb that writes.
#pragma once

#include <app/frame/verb.h>
#include <datasets/files/output_claim.h>

#include <filesystem>
#include <functional>
#include <vector>

namespace swimtwin
{
  /// The files that a scene was read from.
  std::vector<std::filesystem::path> files_of(const CommonOptions &common, const Scene &scene);

  /// A request from a verb's options.
  OutputRequest output_request(const CommonOptions &common, const WrittenFiles &files,
                               std::vector<std::filesystem::path> inputs);

  /// To be called when the new run is under way and earlier results can go; otherwise they go at its end.
  using Begun = std::function<void()>;

  /// Do the work with a claim on the folder (see OutputClaim). If it fails, its InputError or ComputationError also
  /// says what became of earlier results. Called by one rank alone.
  void work_in_folder(const OutputRequest &request, const std::function<void(const Begun &)> &work);

  /// The same of all ranks together: the first one has the claim, and a refusal is thrown by all.
  void work_in_folder_together(const OutputRequest &request, const std::function<void(const Begun &)> &work);
} // namespace swimtwin
