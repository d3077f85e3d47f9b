#include <calibration/run/full_order_check.h>

#include <datasets/system/error.h>
#include <rom/swimmer/dense_algebra.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    struct RatioAt
    {
      double logarithm = 0., ratio = 1.;
    };

    /// Observations in the middle of equal shares of all, by frequency.
    std::vector<int> chosen_observations(const CalibrationData &data, const int n_checks)
    {
      std::vector<int> order(static_cast<std::size_t>(data.n())), chosen;
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(),
                       [&](const int a, const int b) { return data.frequency_Hz[a] < data.frequency_Hz[b]; });
      const int n = std::min(n_checks, data.n());
      for (int k = 0; k < n; ++k)
        chosen.push_back(order[static_cast<std::size_t>((2 * k + 1) * data.n() / (2 * n))]);
      return chosen;
    }

    double interpolated(const std::vector<RatioAt> &known, const double logarithm)
    {
      const auto after =
          std::find_if(known.begin(), known.end(), [&](const RatioAt &point) { return point.logarithm >= logarithm; });
      if (after == known.begin())
        return known.front().ratio;
      if (after == known.end())
        return known.back().ratio;
      const RatioAt &left = *std::prev(after), &right = *after;
      const double   weight = (logarithm - left.logarithm) / std::max(right.logarithm - left.logarithm, 1e-12);
      return (1. - weight) * left.ratio + weight * right.ratio;
    }

    /// Gauss and Newton's step towards the observations from corrected predictions.
    Eigen::VectorXd move(const FitInput &input, const Estimate &estimate, const Eigen::VectorXd &corrected_m)
    {
      const Misfit          misfit = misfit_of(input, estimate);
      const Eigen::VectorXd weights =
          misfit.residuals(estimate.prediction).unaryExpr([&](const double r) { return misfit.loss.weight(r); });
      const Eigen::VectorXd deviations = (estimate.noise_scale * input.data.sigma_m).cwiseQuotient(weights.cwiseSqrt());
      const Eigen::MatrixXd J          = deviations.cwiseInverse().asDiagonal() * estimate.prediction.by_x;
      const Eigen::VectorXd residual   = (input.data.observed_m - corrected_m).cwiseQuotient(deviations);
      const Eigen::MatrixXd &prior     = estimate.information.prior;
      const Eigen::MatrixXd  A         = J.transpose() * J + prior;
      const Eigen::VectorXd  slope     = J.transpose() * residual + prior * (misfit.prior_means - estimate.x());
      return shortest_least_squares(A, slope, null_strength * null_strength);
    }

    std::string verdict(const double largest_move, const std::string &name, const std::size_t n)
    {
      const std::string found =
          fmt::format("with {} full-order runs to correct the reduced model the estimate moves by at most {:.2g} of "
                      "half an interval ({})",
                      n, largest_move, name);
      return largest_move <= 1. ? fmt::format("{}: it stays within its intervals", found)
                                : fmt::format("{}: it leaves its interval; train a better model near the estimate, or "
                                              "state a larger model_error",
                                              found);
    }
  } // namespace

  void check_with_full_order(const FitInput &input, const Estimate &estimate, const CalibrationOptions &options,
                             const double factor, ModelDiscrepancy &discrepancy)
  {
    const CalibratedSwimmer swimmer = input.map.swimmer(estimate.x());
    const double            scale   = swimmer.displacement_scale * swimmer.geometry_scale;
    const Eigen::VectorXd   reduced_m =
        estimate.prediction.value_m -
        estimate.prediction.by_error * estimate.unknowns.tail(estimate.error.n_components());
    const std::vector<int> chosen = chosen_observations(input.data, options.n_checks);
    std::vector<RatioAt>   known;
    try
    {
      for (const int i : chosen)
      {
        const auto   c       = static_cast<std::size_t>(i);
        const double full    = options.full_order(swimmer, input.data.conditions[c]);
        const double reduced = (reduced_m[i] - swimmer.displacement_offset_m) / scale;
        known.push_back({std::log(input.data.frequency_Hz[i]), full / reduced});
        discrepancy.checks.push_back({input.data.set_names[static_cast<std::size_t>(input.data.set[c])],
                                      input.data.frequency_Hz[i], reduced, full});
        if (options.on_progress)
          options.on_progress("full-order check",
                              static_cast<double>(known.size()) / static_cast<double>(chosen.size()));
      }
    }
    catch (const ComputationError &error)
    {
      discrepancy.verdict = fmt::format("the full-order model could not check the estimate: {}", error.what());
      return;
    }
    Eigen::VectorXd corrected(input.data.n());
    for (int i = 0; i < input.data.n(); ++i)
      corrected[i] = swimmer.displacement_offset_m + (reduced_m[i] - swimmer.displacement_offset_m) *
                                                         interpolated(known, std::log(input.data.frequency_Hz[i]));
    const Eigen::VectorXd step = move(input, estimate, corrected);
    discrepancy.moved_estimate = input.map.values(estimate.x() + step);
    std::string name           = "none is determined";
    for (int j = 0; j < input.map.size(); ++j)
      if (!estimate.information.touches_undecided(j))
        if (const double share = std::abs(step[j]) / (factor * std::sqrt(estimate.information.covariance(j, j)));
            share >= discrepancy.largest_move)
        {
          discrepancy.largest_move = share;
          name                     = input.map.names()[static_cast<std::size_t>(j)];
        }
    discrepancy.verdict = verdict(discrepancy.largest_move, name, known.size());
  }
} // namespace swimtwin
