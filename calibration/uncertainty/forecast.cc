#include <calibration/uncertainty/forecast.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    Eigen::VectorXd frequencies(const FitInput &input, const int n)
    {
      const double low  = input.problem.lowest_frequency_Hz.value_or(input.data.frequency_Hz.minCoeff());
      const double high = input.problem.highest_frequency_Hz.value_or(input.data.frequency_Hz.maxCoeff());
      if (low >= high)
        return Eigen::VectorXd::Constant(1, low);
      return Eigen::VectorXd::LinSpaced(n, std::log(low), std::log(high)).array().exp();
    }

    std::optional<Forecast::Curve> curve_of(const FitInput &input, const Estimate &estimate, const ObservationSet &set,
                                            const int index, const Eigen::VectorXd &f, long &n_runs)
    {
      constexpr double               tolerance = 1e-6; // a curve and its derivatives to a per mille
      std::vector<SwimmingCondition> conditions;
      for (const double frequency : f)
        conditions.push_back(condition_of(set, frequency));
      ExactDisplacements exact(
          input.model, conditions,
          {.relative_tolerance = tolerance, .n_threads = input.n_threads, .by = input.map.needed()});
      CalibrationData at;
      at.observed_m = at.sigma_m = Eigen::VectorXd::Ones(f.size());
      const ModelError none{0., 0., "none", {}, Eigen::MatrixXd(f.size(), 0)};
      const Prediction prediction = Misfit(at, input.map, none, RobustLoss()).predict(exact, estimate.x(), true);
      n_runs += exact.n_runs();
      if (!prediction.failure.empty())
        return std::nullopt;
      const CalibratedSwimmer swimmer = input.map.swimmer(estimate.x());
      Forecast::Curve         curve{index, f, prediction.value_m, prediction.by_x, f, f};
      for (Eigen::Index i = 0; i < f.size(); ++i)
      {
        curve.noise_m[i] = estimate.noise_scale * input.data.sigma_at(index, f[i]);
        curve.model_error_m[i] =
            estimate.error.relative_size * std::abs(prediction.value_m[i] - swimmer.displacement_offset_m);
      }
      return curve;
    }
  } // namespace

  Forecast forecast(const FitInput &input, const Estimate &estimate, const std::vector<ObservationSet> &sets,
                    const int n_frequencies)
  {
    Forecast              result;
    const Eigen::VectorXd f = frequencies(input, n_frequencies);
    for (std::size_t s = 0; s < sets.size(); ++s)
      if (auto curve = curve_of(input, estimate, sets[s], static_cast<int>(s), f, result.n_runs))
        result.curves.push_back(std::move(*curve));
    return result;
  }

  PredictionBand prediction_band(const FitInput &input, const Estimate &estimate, const Forecast::Curve &curve,
                                 const double factor)
  {
    PredictionBand         band;
    const Eigen::MatrixXd &C = estimate.information.covariance;
    band.data_set            = input.data.set_names[static_cast<std::size_t>(curve.set)];
    for (Eigen::Index i = 0; i < curve.frequency_Hz.size(); ++i)
    {
      const Eigen::RowVectorXd j        = curve.by_x.row(i);
      const double             variance = j.dot(C * j.transpose());
      const double             half     = factor * std::sqrt(variance);
      const double             of_one =
          factor * std::sqrt(variance + std::pow(curve.noise_m[i], 2) + std::pow(curve.model_error_m[i], 2));
      band.frequency_Hz.push_back(curve.frequency_Hz[i]);
      band.value.push_back(curve.value_m[i]);
      band.low.push_back(curve.value_m[i] - half);
      band.high.push_back(curve.value_m[i] + half);
      band.observation_low.push_back(curve.value_m[i] - of_one);
      band.observation_high.push_back(curve.value_m[i] + of_one);
    }
    return band;
  }

  std::optional<NextExperiment> next_experiment(const FitInput &input, const Estimate &estimate,
                                                const Forecast &forecast, const int parameter)
  {
    if (estimate.information.touches_undecided(parameter))
      return std::nullopt;
    const Eigen::MatrixXd        &C = estimate.information.covariance;
    std::optional<NextExperiment> best;
    for (const Forecast::Curve &curve : forecast.curves)
    {
      NextExperiment next;
      double         most_information = -1.;
      next.parameter                  = input.map.names()[static_cast<std::size_t>(parameter)];
      next.data_set                   = input.data.set_names[static_cast<std::size_t>(curve.set)];
      for (Eigen::Index i = 0; i < curve.frequency_Hz.size(); ++i)
      {
        const Eigen::RowVectorXd j  = curve.by_x.row(i);
        const Eigen::VectorXd    Cj = C * j.transpose();
        const double             v  = std::pow(curve.noise_m[i], 2) + std::pow(curve.model_error_m[i], 2);
        const double             c  = C(parameter, parameter) - std::pow(Cj[parameter], 2) / (v + j.dot(Cj));
        next.frequency_Hz.push_back(curve.frequency_Hz[i]);
        next.interval_ratio.push_back(std::sqrt(c / C(parameter, parameter)));
        next.information_gain.push_back(std::log1p(j.dot(Cj) / v));
        if (next.interval_ratio.back() < next.best_interval_ratio)
        {
          next.best_interval_ratio = next.interval_ratio.back();
          next.best_frequency_Hz   = curve.frequency_Hz[i];
        }
        if (next.information_gain.back() > most_information)
        {
          most_information                   = next.information_gain.back();
          next.most_informative_frequency_Hz = curve.frequency_Hz[i];
        }
      }
      if (!best || next.best_interval_ratio < best->best_interval_ratio)
        best = next;
    }
    return best;
  }
} // namespace swimtwin
