// How far a reduced model was off in runs that it was not trained on: in all of them, and near to a run of one's own.
#pragma once

#include <datasets/reduced/reduced_model.h>

#include <optional>
#include <string>

namespace swimtwin
{
  /// Of displacements of the third period, relative (0.01: one per cent).
  struct HeldOutError
  {
    double rms = 0., worst = 0.;
    int    n_runs = 0;

    bool is_known() const { return n_runs > 0; }
    /// Whether the root mean square is within the target, and no run is off by more than twice as much.
    bool is_within(const double target) const { return is_known() && rms <= target && worst <= 2. * target; }
    /// "23 % rms, 26 % worst in 4 full-order runs not trained on"
    std::string text() const;
  };

  /// What a model aims at that does not say.
  constexpr double usual_target = 0.01;
  /// What a fit, a plan and a path may rest on without being told to.
  constexpr double largest_borne_error = 0.05;

  /// What errors are relative to: the displacement, or a twentieth of the largest one in the record where that is more.
  double error_scale_m(const TrainingRecord &record, double displacement_m);

  /// Of a run's displacement, relative to the full-order one (error_scale_m).
  double       relative_error(const HeldOutRun &run, const TrainingRecord &record);
  HeldOutError displacement_error(const TrainingRecord &record);
  double       target_of(const TrainingRecord &record);

  /// What is known of a displacement's error beside the held-out runs: how far other models of the same swimmer are off
  /// it (m).
  struct ErrorSigns
  {
    double displacement_m = 0.;
    double fit_change_m   = 0.; ///< with the resistance fitted to half of the samples
  };
  ErrorSigns error_signs(const HeldOutRun &run);

  /// The full-order displacement lies within this (m) of the model's with 95 %: errors of held-out runs, each over the
  /// size that its signs let expect, are taken for a sample of one normal distribution (Student's quantile). Not known
  /// (NaN) without held-out runs.
  double error_bound_m(const TrainingRecord &record, const ErrorSigns &signs);
  /// Of a held-out run's displacement, by all the other ones: what would have been stated had it not been known.
  double left_out_bound_m(const TrainingRecord &record, std::size_t run);

  /// One sentence if held-out runs missed the model's target, else empty; also empty if there are none.
  std::string missed_target(const TrainingRecord &record);

  /// A run in the numbers that alone decide how it moves without inertia.
  struct RunGroups
  {
    double elastic = 0., magnetic = 0., slope = 0.; ///< log E/(mu f), log M|B|/(mu f), angle of the field's swing
  };
  RunGroups run_groups(const HeldOutRun &parameters);

  /// Error that held-out runs near to these parameters (its results do not count) had: root mean square with weights
  /// that fall over a factor of about two in the groups; far from all of them, that of all. Nothing without any.
  std::optional<double> error_nearby(const TrainingRecord &record, const HeldOutRun &parameters);
} // namespace swimtwin
