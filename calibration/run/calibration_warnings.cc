#include <calibration/fit/noise_level.h>
#include <calibration/run/calibration_warnings.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using Warnings = std::vector<std::string>;

    void warn_of_trust(const CalibrationResult &result, Warnings &warnings)
    {
      const auto &all     = result.residuals;
      const auto  outside = [](const ObservationResidual &r) { return !r.trust.empty(); };
      const auto  first   = std::find_if(all.begin(), all.end(), outside);
      if (first != all.end())
        warnings.push_back(fmt::format(
            "at the estimate {} of {} observations are outside what the model was trained for (the first, {:.4g} Hz: "
            "{})",
            std::count_if(all.begin(), all.end(), outside), all.size(), first->frequency_Hz, first->trust));
    }

    void warn_of_bounds(const CalibrationResult &result, Warnings &warnings)
    {
      for (const CalibratedParameter &p : result.parameters)
        if (p.role == ParameterRole::free && p.at_bound && !p.undetermined)
          warnings.push_back(fmt::format("{} = {:.4g} lies at its bound: its interval ends there; widen the bounds if "
                                         "they are not physical",
                                         p.name, p.value));
    }

    /// Starts and bootstrap samples that are missing.
    void warn_of_failures(const CalibrationResult &result, Warnings &warnings)
    {
      const auto n_starts = std::count_if(result.starts.begin(), result.starts.end(), [](const FitStart &start) {
        return start.status == to_string(MinimumStatus::failed);
      });
      if (n_starts > 0)
        warnings.push_back(fmt::format("{} of {} starts could not be computed: of their surroundings nothing is known; "
                                       "the table of starts says which",
                                       n_starts, result.starts.size()));
      if (result.n_bootstrap_failures > 0)
        warnings.push_back(fmt::format("{} of {} bootstrap samples could not be fitted: intervals and robust plans "
                                       "rest on the others",
                                       result.n_bootstrap_failures,
                                       result.n_bootstrap_failures + result.bootstrap.rows()));
    }

    /// Largest residual beside the others of its fit.
    constexpr double far = 5.;

    double in_sigma(const CalibrationResult &result, const ObservationResidual &residual)
    {
      return result.swimmer.noise_scale * std::abs(residual.standardised);
    }

    /// Which residual is the largest.
    std::size_t find_worst(const CalibrationResult &result)
    {
      const auto &all     = result.residuals;
      const auto  smaller = [&](const auto &a, const auto &b) { return in_sigma(result, a) < in_sigma(result, b); };
      return static_cast<std::size_t>(std::max_element(all.begin(), all.end(), smaller) - all.begin());
    }

    /// Of the other residuals in sigma: a Gaussian's standard deviation from the median, which outliers do not move.
    double size_of_others(const CalibrationResult &result, const std::size_t left_out)
    {
      std::vector<double> sizes;
      for (std::size_t i = 0; i < result.residuals.size(); ++i)
        if (i != left_out)
          sizes.push_back(in_sigma(result, result.residuals[i]));
      const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
      std::nth_element(sizes.begin(), middle, sizes.end());
      return 1.4826 * *middle;
    }

    /// `curve.csv:7: the observation at 0.72 Hz`.
    std::string name_of(const std::size_t observation, const std::vector<ObservationSet> &sets,
                        const CalibrationResult &result)
    {
      std::vector<std::string> where;
      for (const ObservationSet &set : sets)
        for (const Observation &point : set.points)
          where.push_back(point.where);
      return fmt::format("{}: the observation at {:.4g} Hz", where.at(observation),
                         result.residuals[observation].frequency_Hz);
    }

    /// Residuals that are too large, least squares, and whether one observation is to blame.
    void warn_of_scatter(const CalibrationProblem &problem, const std::vector<ObservationSet> &sets,
                         const CalibrationResult &result, Warnings &warnings)
    {
      if (problem.loss != LossKind::least_squares || result.residuals.size() < 3)
        return;
      const std::size_t worst = find_worst(result);
      const double      size  = in_sigma(result, result.residuals[worst]);
      if (size > far * std::max(1., size_of_others(result, worst)))
        warnings.push_back(fmt::format(
            "{} is {:.3g} sigma away from the fit, far more than the others, and pulls the estimate; correct "
            "it or leave it out, or use a loss that it cannot pull: [loss] kind = \"huber\" (or \"cauchy\") "
            "in the problem file",
            name_of(worst, sets, result), size));
      if (result.n_degrees_of_freedom < 1 || free_noise_scale(problem) != nullptr)
        return;
      const boost::math::chi_squared law(result.n_degrees_of_freedom);
      const double                   larger = boost::math::cdf(boost::math::complement(law, result.chi_squared));
      if (larger < 1e-3)
        warnings.push_back(fmt::format("the residuals are larger than the stated sigma explain (chi^2 = {:.4g} at {} "
                                       "degrees of freedom; {} is {:.3g} sigma away): intervals are too short; free "
                                       "noise_scale, use a robust loss ([loss] kind = \"huber\"), or look for what the "
                                       "model lacks",
                                       result.chi_squared, result.n_degrees_of_freedom, name_of(worst, sets, result),
                                       size));
    }

    void warn_of_length(const CalibrationModel &model, const ObservationSet &set, Warnings &warnings)
    {
      constexpr double as_measured = 0.05; // on a picture
      const double     length_m    = set.body_length_m.value_or(model.body_length_m);
      if (std::abs(length_m - model.body_length_m) > as_measured * model.body_length_m)
        warnings.push_back(
            fmt::format("{}: of a body {:.4g} mm long, as its sidecar says, and the model's is {:.4g} mm: "
                        "if it is another swimmer, train a model of it",
                        set.name, 1e3 * length_m, 1e3 * model.body_length_m));
    }
  } // namespace

  std::vector<std::string> data_warnings(const CalibrationModel &model, const std::vector<ObservationSet> &sets)
  {
    Warnings warnings;
    for (const ObservationSet &set : sets)
    {
      warnings.insert(warnings.end(), set.warnings.begin(), set.warnings.end());
      warn_of_length(model, set, warnings);
    }
    for (const ObservationSet &set : sets)
      if (!set.body_length_m)
        for (const std::string &warning : implausible_sizes(set, model.body_length_m))
          if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
            warnings.push_back(warning);
    return warnings;
  }

  std::vector<std::string> calibration_warnings(const FitInput &input, const std::vector<ObservationSet> &sets,
                                                const Estimate &estimate, const CalibrationResult &result)
  {
    Warnings warnings = data_warnings(input.model, sets);
    warn_of_trust(result, warnings);
    warn_of_bounds(result, warnings);
    warn_of_scatter(input.problem, sets, result, warnings);
    warn_of_failures(result, warnings);
    if (estimate.error.origin == "none" && !input.problem.model_error)
      warnings.push_back("the model has no held-out runs, so its own error is not known and counts as zero");
    return warnings;
  }
} // namespace swimtwin
