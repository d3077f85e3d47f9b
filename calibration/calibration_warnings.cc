#include <calibration/calibration_warnings.h>
#include <calibration/noise_level.h>

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

    /// Largest residual beside the others of its fit, in their size (a median is not moved by it) and in sigma.
    constexpr double far = 5.;

    double size_without(const std::vector<ObservationResidual> &residuals, const std::size_t left_out)
    {
      std::vector<double> sizes;
      for (std::size_t i = 0; i < residuals.size(); ++i)
        if (i != left_out)
          sizes.push_back(std::abs(residuals[i].standardised));
      const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
      std::nth_element(sizes.begin(), middle, sizes.end());
      return 1.4826 * *middle; // a Gaussian's standard deviation from its median
    }

    void warn_of_outlier(const CalibrationProblem &problem, const std::vector<ObservationSet> &sets,
                         const CalibrationResult &result, Warnings &warnings)
    {
      const auto &all = result.residuals;
      if (problem.loss != LossKind::least_squares || all.size() < 3)
        return;
      const auto   worst = std::max_element(all.begin(), all.end(), [](const auto &a, const auto &b) {
        return std::abs(a.standardised) < std::abs(b.standardised);
      });
      const auto   index = static_cast<std::size_t>(worst - all.begin());
      const double size  = std::abs(worst->standardised);
      if (size < far * std::max(1., size_without(all, index)))
        return;
      std::vector<std::string> where;
      for (const ObservationSet &set : sets)
        for (const Observation &point : set.points)
          where.push_back(point.where);
      warnings.push_back(
          fmt::format("{}: the observation at {:.4g} Hz is {:.3g} sigma away from the fit, far more than the "
                      "others, and pulls the estimate; correct it or leave it out, or use a loss that it "
                      "cannot pull: [loss] kind = \"huber\" (or \"cauchy\") in the problem file",
                      where.at(index), worst->frequency_Hz, size));
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
    warn_of_outlier(input.problem, sets, result, warnings);
    warn_of_scatter(input.problem, result, warnings);
    if (estimate.error.origin == "none" && !input.problem.model_error)
      warnings.push_back("the model has no held-out runs, so its own error is not known and counts as zero");
    return warnings;
  }
} // namespace swimtwin
