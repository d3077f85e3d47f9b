// What a fit of the swimmer to displacement-frequency data found, and what the data cannot tell: calibration.json.
#pragma once

#include <datasets/run/refinement.h>
#include <datasets/system/provenance.h>

#include <Eigen/Dense>

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Everything about the swimmer and its recording that a fit may change, in SI units.
  struct CalibratedSwimmer
  {
    double young_modulus_Pa = 0., viscosity_Pa_s = 0., magnetization_A_m = 0.;
    double field_scale           = 1.; ///< the field at the swimmer over the one that was recorded
    double geometry_scale        = 1.; ///< lengths of swimmer and domain over the scene's
    double displacement_offset_m = 0., displacement_scale = 1.; ///< recorded = offset + scale x true displacement
    double noise_scale = 1.;                                    ///< the scatter over the sigma that was stated
  };

  /// A range that was computed at the result's level. Without a bound, none can be claimed on that side.
  struct ClaimedInterval
  {
    std::string           method; ///< "profile", "bootstrap", "curvature"; empty: not computed
    std::optional<double> low, high;
    std::string           note; ///< one sentence: why a bound is missing

    bool is_finite() const { return low && high; }
  };

  enum class ParameterRole {
    free,   ///< fitted
    fixed,  ///< given
    derived ///< follows from fitted ones: a ratio
  };
  const char *to_string(ParameterRole role);

  struct CalibratedParameter
  {
    std::string           name; ///< with its unit, as in the problem file: young_modulus_over_viscosity_1_s
    ParameterRole         role        = ParameterRole::fixed;
    bool                  logarithmic = true; ///< standard error and null directions are those of its logarithm
    double                value       = 0.;
    std::optional<double> standard_error; ///< in the parameter's unit, from the curvature; absent if undetermined
    double                lower = 0., upper = 0.; ///< bounds of a free one
    std::optional<double> prior_mean, prior_standard_deviation;
    bool                  at_bound     = false;
    bool                  undetermined = false; ///< part of a null direction
    ClaimedInterval       curvature, profile, bootstrap;

    /// The best that was computed: profile, else bootstrap, else curvature.
    const ClaimedInterval &interval() const;
  };

  /// A change of the free parameters that the data do not see.
  struct NullDirection
  {
    Eigen::VectorXd direction;      ///< of unit length, in scaled variables (logarithms), one entry per free parameter
    double          strength  = 0.; ///< its singular value over the largest one
    bool            has_prior = false; ///< a prior alone decides it
    std::string     reading;           ///< one sentence: what goes together and what to do
  };

  struct FitStart
  {
    Eigen::VectorXd start, end; ///< values of the free parameters
    double          misfit_at_start = 0., misfit = 0.;
    std::string     status;
    double          kkt_residual  = 0.;
    int             n_evaluations = 0;
  };

  struct TraceStep
  {
    int    n_evaluations = 0;
    double misfit        = 0.;
  };

  struct ParameterProfile
  {
    std::string         name;
    std::vector<double> value, misfit_increase; ///< 2 x (misfit - its minimum), to be compared with `threshold`
    double              threshold = 0.;
  };

  /// Prediction against frequency for one data set, with what the parameters leave open, at the result's level.
  struct PredictionBand
  {
    std::string         data_set;
    std::vector<double> frequency_Hz, value;
    std::vector<double> low, high;                         ///< of the curve
    std::vector<double> observation_low, observation_high; ///< of a new observation: with noise and the model's error
  };

  struct ObservationResidual
  {
    std::string data_set;
    double      frequency_Hz = 0., observed = 0., sigma = 0., predicted = 0.;
    double      model_error  = 0.; ///< standard deviation of the reduced model's own error
    double      standardised = 0.; ///< (observed - predicted - fitted model error) / (noise_scale x sigma)
    double      weight       = 1.; ///< that the loss leaves to this observation
    std::string trust;             ///< why the prediction may not be trusted; empty if it may
  };

  /// What one more observation at each frequency would do to the chosen parameter's interval.
  struct NextExperiment
  {
    std::string         parameter;
    std::string         data_set;                     ///< whose field and period
    std::vector<double> frequency_Hz, interval_ratio; ///< expected width over today's
    std::vector<double> information_gain;             ///< growth of the information's log-determinant
    double              best_frequency_Hz = 0., best_interval_ratio = 1.;
    double              most_informative_frequency_Hz = 0.; ///< for all parameters together
  };

  struct FullOrderCheck
  {
    std::string data_set;
    double      frequency_Hz = 0., reduced = 0., full_order = 0.;
  };

  /// The reduced model's own error, and what it does to the estimate.
  struct ModelDiscrepancy
  {
    double                      relative_size       = 0.; ///< standard deviation, of the displacement
    double                      correlation_decades = 0.;
    std::string                 origin;         ///< "held-out runs", "given", "none"
    std::vector<FullOrderCheck> checks;         ///< full-order runs at the optimum
    Eigen::VectorXd             moved_estimate; ///< of the free parameters, when the checks correct the model; or empty
    double                      largest_move = 0.; ///< over half the parameter's interval
    std::string                 verdict;           ///< one sentence

    /// Of both models in the checks, relative to the full-order one, at least 5 % of the largest.
    double largest_difference() const;
  };

  struct CalibrationResult
  {
    std::string status = "not run"; ///< "converged", "undetermined", "budget exhausted", "stalled", "failed: ..."
    std::string message;
    double      level = 0.95;

    CalibratedSwimmer                swimmer;    ///< at the estimate
    std::vector<CalibratedParameter> parameters; ///< free ones first, in the problem's order

    double                   misfit = 0., chi_squared = 0.;
    std::vector<std::string> inertia; ///< terms that the reduced swimmer carried, by their names in [fluid] inertia
    int                      n_observations = 0, n_degrees_of_freedom = 0;
    double                   kkt_residual  = 0.;
    double                   polish_step   = 0.; ///< largest change of a scaled variable by the polish
    int                      n_evaluations = 0, max_evaluations = 0; ///< per start: the budget
    long                     n_runs               = 0;               ///< of the reduced swimmer
    double                   integrator_tolerance = 0.;
    std::string              loss;

    std::vector<FitStart>  starts; ///< the waterfall, best first
    std::vector<TraceStep> trace;  ///< of the best start

    Eigen::MatrixXd            covariance, correlation; ///< of the free parameters' scaled variables; NaN: undetermined
    Eigen::VectorXd            singular_values;         ///< of the whitened sensitivities, largest first
    std::vector<NullDirection> null_directions;

    std::vector<ParameterProfile> profiles;
    Eigen::MatrixXd               bootstrap; ///< n x free parameters; may be empty
    int                           n_bootstrap_failures = 0;
    /// Swimmers as likely as the data allow, for robust plans: the bootstrap's, or drawn from the curvature. Along null
    /// directions they stay at the estimate, which changes no motion.
    std::vector<CalibratedSwimmer>   posterior;
    std::string                      posterior_method;
    std::vector<PredictionBand>      bands;
    std::vector<ObservationResidual> residuals;
    std::optional<NextExperiment>    next;
    ModelDiscrepancy                 discrepancy;
    std::vector<RefinementRound>     refinement; ///< of the model: each round's, the last one made this fit; or empty
    std::vector<std::string>         warnings;   ///< outside the trained range, implausible data, ...

    std::string              model_file, scene_name, problem_text;
    std::vector<std::string> data_files;
    Provenance               provenance;
    double                   fit_time_s = 0., uncertainty_time_s = 0.;

    bool                     converged() const { return status == "converged"; }
    std::vector<std::string> free_names() const;
    /// Null if there is no such parameter.
    const CalibratedParameter *find(const std::string &name) const;
  };

  void write_calibration_result(const std::filesystem::path &file, const CalibrationResult &result);
  /// Throws InputError that names the file and what is missing or of the wrong kind.
  CalibrationResult read_calibration_result(const std::filesystem::path &file);
} // namespace swimtwin
