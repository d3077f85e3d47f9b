// Displacements by integration of the reduced swimmer, with exact sensitivities.
#pragma once

#include <calibration/misfit/calibration_data.h>
#include <calibration/misfit/displacement_source.h>

#include <rom/sensitivity/periodic_orbit.h>

#include <array>
#include <memory>
#include <vector>

namespace swimtwin
{
  /// The reduced swimmer of a fit: what all threads share. It does not change.
  struct CalibrationModel
  {
    explicit CalibrationModel(const ReducedModel &model, const InertiaTerms &carried = {});

    InertiaTerms      inertia; ///< that all runs carry
    ReducedSwimmer    swimmer;
    TrainedRange      range;
    RunRequest        base;               ///< the scene's own run: parameters, field, rest
    double            heading_rad   = 0.; ///< displacement counts along -(cos, sin)
    double            body_length_m = 0.;
    CalibratedSwimmer nominal; ///< of the scene
  };

  struct ExactOptions
  {
    double                                relative_tolerance = 1e-7;
    int                                   n_threads          = 1;
    std::array<bool, n_motion_quantities> by                 = {true, true, true, true}; ///< derivatives wanted
  };

  class ExactDisplacements : public DisplacementSource
  {
  public:
    /// `model` must live as long.
    ExactDisplacements(const CalibrationModel &model, std::vector<SwimmingCondition> conditions,
                       const ExactOptions &options);
    ~ExactDisplacements() override;

    int                  n_conditions() const override { return static_cast<int>(conditions_.size()); }
    const Displacements &evaluate(const CalibratedSwimmer &swimmer, bool derivatives) override;

    long n_runs() const { return n_runs_; } ///< so far

    /// Why predictions for this swimmer may not be trusted, one per condition; empty where they may (see trust_notes).
    std::vector<std::string> trust(const CalibratedSwimmer &swimmer) const;

  private:
    class Worker;

    const CalibrationModel              &model_;
    std::vector<SwimmingCondition>       conditions_;
    ExactOptions                         options_;
    std::vector<std::unique_ptr<Worker>> workers_;
    Displacements                        result_;
    long                                 n_runs_ = 0;
  };

  /// The scene's run with this swimmer under this condition.
  RunRequest run_request(const CalibrationModel &model, const SwimmingCondition &condition,
                         const CalibratedSwimmer &swimmer);
} // namespace swimtwin
