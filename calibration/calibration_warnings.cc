#include <calibration/calibration_warnings.h>
#include <calibration/noise_level.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>

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

    void warn_of_scatter(const CalibrationProblem &problem, const CalibrationResult &result, Warnings &warnings)
    {
      if (result.n_degrees_of_freedom < 1 || free_noise_scale(problem) != nullptr ||
          problem.loss != LossKind::least_squares)
        return;
      const boost::math::chi_squared law(result.n_degrees_of_freedom);
      const double                   larger = boost::math::cdf(boost::math::complement(law, result.chi_squared));
      if (larger < 1e-3)
        warnings.push_back(fmt::format("the residuals are larger than the stated sigma explain (chi^2 = {:.4g} at {} "
                                       "degrees of freedom): intervals are too short; free noise_scale, use a robust "
                                       "loss, or look for what the model lacks",
                                       result.chi_squared, result.n_degrees_of_freedom));
    }
  } // namespace

  std::vector<std::string> data_warnings(const CalibrationModel &model, const std::vector<ObservationSet> &sets)
  {
    Warnings warnings;
    for (const ObservationSet &set : sets)
      warnings.insert(warnings.end(), set.warnings.begin(), set.warnings.end());
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
    warn_of_scatter(input.problem, result, warnings);
    if (estimate.error.origin == "none" && !input.problem.model_error)
      warnings.push_back("the model has no held-out runs, so its own error is not known and counts as zero");
    return warnings;
  }
} // namespace swimtwin
