// A laboratory written in TOML, and its frames as lines of the twin's stream.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <twin/lab/laboratory.h>
#include <twin/stream/message.h>

#include <filesystem>
#include <functional>
#include <string>

namespace swimtwin
{
  struct LabConfig
  {
    LaboratoryOptions options;
    double            bx_T = 0., by_T = 0., frequency_Hz = 0.;
    double            duration_s       = 60.;
    double            real_time        = 0.; ///< seconds of the laboratory in a second; 0: as fast as it goes
    bool              tells_sigmas     = true;
    bool              is_steered       = false; ///< the coils play what a twin says, nothing before
    double            ticks_per_second = 20.;   ///< of the clock that a steered one sends
  };

  /// What the file leaves out is the model's scene's. Throws InputError with file, line, key, rule and remedy.
  LabConfig read_lab_config(const std::filesystem::path &file, const ReducedModel &model);

  /// What happened in truth at an instant.
  struct LabTruth
  {
    double          time_s = 0.;
    Eigen::VectorXd state; ///< swimmer and all parameters
  };

  /// What a laboratory is joined to.
  struct LabEnds
  {
    /// When a line arrives; false to end early. Lines come in the order in which they arrive.
    std::function<bool(double arrives_s, const std::string &line)> send;
    /// One instant per frame, sent or not.
    std::function<void(const LabTruth &)> truth = [](const LabTruth &) {};
    /// What a twin has said since the last time, after the clock's line of this instant.
    std::function<std::vector<PlayMessage>(double clock_s)> hear = {};
  };

  /// Runs it to its end.
  void run_laboratory(const ReducedModel &model, const LabConfig &config, const LabEnds &ends);
} // namespace swimtwin
