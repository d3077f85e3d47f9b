// What is to be fitted, within which bounds and how: the problem file of `calibrate`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What a fit may change. The two ratios are what displacements can tell.
  enum class FittedQuantity {
    young_modulus_over_viscosity,
    magnetization_over_viscosity,
    young_modulus,
    viscosity,
    magnetization,
    field_scale,
    geometry_scale,
    displacement_scale,
    displacement_offset,
    noise_scale
  };
  /// With its unit, as in the problem file: young_modulus_Pa.
  /// Names of the searches that may fit: all of optimization/search_method.h.
  const std::vector<std::string>    &calibration_methods();
  std::string                        key_of(FittedQuantity quantity);
  const std::vector<FittedQuantity> &all_fitted_quantities();

  struct GaussianPrior
  {
    double mean = 0., standard_deviation = 0.; ///< in the parameter's unit; of its logarithm if that is fitted
  };

  struct FreeParameter
  {
    FittedQuantity               quantity = FittedQuantity::young_modulus;
    double                       lower = 0., upper = 0.;
    bool                         logarithmic = true;
    std::optional<double>        start; ///< tried before the others
    std::optional<GaussianPrior> prior;
  };

  struct GivenValue
  {
    FittedQuantity quantity = FittedQuantity::viscosity;
    double         value    = 0.;
  };

  enum class LossKind { least_squares, huber, pseudo_huber, cauchy };
  std::string to_string(LossKind kind);

  struct CalibrationProblem
  {
    std::vector<std::filesystem::path> data; ///< relative to the problem file's folder
    std::vector<FreeParameter>         free; ///< in the order of FittedQuantity
    std::vector<GivenValue>            given;

    LossKind loss       = LossKind::least_squares;
    double   loss_width = 1.345; ///< residual, in sigma, from which the robust losses count less

    int         n_starts        = 32;
    int         seed            = 1;   ///< of starts and bootstrap
    int         max_evaluations = 200; ///< per start
    std::string method          = "lbfgs";
    bool        allow_untrained = false; ///< bounds may lie outside what the model was trained for

    double                level               = 0.95;
    bool                  profiles            = true;
    int                   n_bootstrap_samples = 400;
    std::optional<double> model_error; ///< relative standard deviation; absent: from the model's held-out runs

    std::string           next_parameter; ///< whose interval the next observation is to shrink; empty: the first free
    std::optional<double> lowest_frequency_Hz, highest_frequency_Hz; ///< of band and next observation

    std::string text; ///< of the file
  };

  /// Throws InputError with file, line, key, rule and remedy.
  CalibrationProblem read_calibration_problem(const std::filesystem::path &file);
  /// The same from text; `name` stands for the file in messages, data are relative to `folder`.
  CalibrationProblem parse_calibration_problem(std::string_view text, const std::string &name,
                                               const std::filesystem::path &folder);
} // namespace swimtwin
