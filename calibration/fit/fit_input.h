// What a fit works with, and where it takes displacements from.
#pragma once

#include <calibration/misfit/displacement_table.h>
#include <calibration/misfit/parameter_map.h>

#include <datasets/reduced/reduced_model.h>

#include <functional>
#include <memory>
#include <string>

namespace swimtwin
{
  /// All must live as long.
  struct FitInput
  {
    const CalibrationModel                                   &model;
    const ReducedModel                                       &reduced; ///< that `model` was made of
    const CalibrationProblem                                 &problem;
    const CalibrationData                                    &data;
    const ParameterMap                                       &map;
    int                                                       n_threads   = 1;
    std::function<void(const std::string &what, double done)> on_progress = {}; ///< by any thread, one at a time

    void show(const std::string &what, double done) const;
  };

  /// The groups of all swimmers within the bounds.
  GroupBox groups_within_bounds(const FitInput &input);

  /// By runs, with the derivatives that the free parameters need.
  std::unique_ptr<ExactDisplacements> exact_displacements(const FitInput &input, double relative_tolerance,
                                                          int n_threads);
  /// From a table, whose runs are added to `n_runs`; null if one of them cannot be computed.
  std::shared_ptr<DisplacementTable> tabulated_displacements(const FitInput &input, const GroupBox &box,
                                                             const TableOptions &options, long &n_runs);
} // namespace swimtwin
