// The twin at work: lines from a stream, a port or a recording; answers to where they came from; a folder.
#pragma once

#include <twin/run/twin_folder.h>
#include <twin/stream/recorded_lines.h>

#include <filesystem>
#include <functional>
#include <optional>

namespace swimtwin
{
  struct ServiceOptions
  {
    std::filesystem::path         folder;
    std::optional<int>            port;                 ///< of this machine
    std::optional<int>            page_port;            ///< of this machine, for the live page
    std::optional<RecordedStream> recording;            ///< none: standard input
    bool                          in_real_time = false; ///< a recording, at the pace of its stamps
    bool                          resumes      = false;
    std::string                   fingerprint; ///< of model and configuration, with which alone a killed twin goes on
    Provenance                    provenance;
    std::function<void()>         on_begun; ///< called when ports are open, before anything is written
  };

  /// Until the lines end. Throws InputError and ComputationError.
  void serve(const ReducedModel &model, const TwinConfig &config, const ServiceOptions &options);
} // namespace swimtwin
