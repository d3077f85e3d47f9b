// A laboratory at work: its frames as lines of the twin's stream.
#pragma once

#include <twin/lab/lab_config.h>
#include <twin/lab/laboratory.h>
#include <twin/stream/message.h>

#include <functional>
#include <string>

namespace swimtwin
{
  /// What happened in truth at an instant.
  struct LabTruth
  {
    double          time_s = 0.;
    Eigen::VectorXd state; ///< of the swimmer, as its `truth_names` say
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
  void run_laboratory(Laboratory &lab, const LabConfig &config, const LabEnds &ends);
  /// One with a reduced swimmer.
  void run_laboratory(const ReducedModel &model, const LabConfig &config, const LabEnds &ends);
} // namespace swimtwin
