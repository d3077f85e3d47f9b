// A made-up fit of three parameters to two data sets, with everything that a picture or page shows.
#pragma once

#include <datasets/observation/calibration_result.h>

#include <cmath>
#include <random>

namespace swimtwin
{
  /// Displacement (m) of a curve with a peak at `peak_Hz`.
  inline double synthetic_curve(const double frequency_Hz, const double peak_Hz)
  {
    const double x = frequency_Hz / peak_Hz;
    return 3.6e-4 * x / (1. + x * x);
  }

  inline CalibratedParameter synthetic_parameter(const std::string &name, const double value,
                                                 const double relative_error)
  {
    CalibratedParameter parameter;
    parameter.name           = name;
    parameter.role           = ParameterRole::free;
    parameter.value          = value;
    parameter.standard_error = relative_error * value;
    parameter.lower          = 0.2 * value;
    parameter.upper          = 5. * value;
    parameter.profile = {"profile", value * std::exp(-2. * relative_error), value * std::exp(2.1 * relative_error), ""};
    parameter.bootstrap = {"bootstrap", value * std::exp(-2. * relative_error), value * std::exp(2. * relative_error),
                           ""};
    parameter.curvature = {"curvature", value * (1. - 1.96 * relative_error), value * (1. + 1.96 * relative_error), ""};
    return parameter;
  }

  inline void add_synthetic_set(CalibrationResult &result, const std::string &name, const double peak_Hz,
                                std::mt19937 &noise)
  {
    std::normal_distribution<double> unit;
    PredictionBand                   band;
    band.data_set = name;
    for (double f = 0.15; f < 3.1; f *= 1.06)
    {
      const double value = synthetic_curve(f, peak_Hz);
      band.frequency_Hz.push_back(f);
      band.value.push_back(value);
      band.low.push_back(0.985 * value);
      band.high.push_back(1.015 * value);
      band.observation_low.push_back(0.955 * value);
      band.observation_high.push_back(1.045 * value);
    }
    result.bands.push_back(band);
    for (const double f : {0.2, 0.28, 0.37, 0.47, 0.58, 0.72, 0.9, 1.1, 1.35, 1.7, 2.1, 2.6})
    {
      ObservationResidual residual;
      residual.data_set     = name;
      residual.frequency_Hz = f;
      residual.predicted    = synthetic_curve(f, peak_Hz);
      residual.sigma        = 0.02 * residual.predicted;
      residual.standardised = unit(noise);
      residual.observed     = residual.predicted + residual.sigma * residual.standardised;
      result.residuals.push_back(residual);
    }
  }

  inline void add_synthetic_starts(CalibrationResult &result, std::mt19937 &noise)
  {
    std::exponential_distribution<double> far(1.);
    for (int i = 0; i < 32; ++i)
    {
      FitStart start;
      start.misfit          = i < 27 ? 9.87 : 41.3 + 7. * (i - 27);
      start.misfit_at_start = start.misfit + 2000. * far(noise);
      start.status          = i < 30 ? "converged" : "stalled";
      result.starts.push_back(start);
    }
  }

  inline void add_synthetic_profile(CalibrationResult &result, const CalibratedParameter &parameter)
  {
    ParameterProfile profile;
    profile.name      = parameter.name;
    profile.threshold = 3.84;
    for (int i = -12; i <= 12; ++i)
    {
      const double step = 0.25 * i;
      profile.value.push_back(parameter.value + *parameter.standard_error * step);
      profile.misfit_increase.push_back(step * step * (1. - 0.06 * step));
    }
    result.profiles.push_back(profile);
  }

  inline void add_synthetic_bootstrap(CalibrationResult &result, std::mt19937 &noise)
  {
    const auto      n      = static_cast<Eigen::Index>(result.parameters.size());
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j)
        factor(i, j) = i == j ? 0.01 : 0.008;
    result.covariance = factor * factor.transpose();
    result.bootstrap.resize(400, n);
    std::normal_distribution<double> unit;
    for (Eigen::Index row = 0; row < 400; ++row)
    {
      const Eigen::VectorXd step = factor * Eigen::VectorXd::NullaryExpr(n, [&] { return unit(noise); });
      for (Eigen::Index k = 0; k < n; ++k)
        result.bootstrap(row, k) = result.parameters[static_cast<std::size_t>(k)].value * std::exp(step[k]);
    }
  }

  inline NextExperiment synthetic_next()
  {
    NextExperiment next;
    next.parameter = "young_modulus_over_viscosity_1_s";
    next.data_set  = "soft";
    for (double f = 0.1; f < 3.; f *= 1.05)
    {
      next.frequency_Hz.push_back(f);
      next.interval_ratio.push_back(1. - 0.13 * std::exp(-4. * std::pow(std::log(f / 1.6), 2)));
      next.information_gain.push_back(0.2 + 0.3 * std::exp(-2. * std::pow(std::log(f / 0.5), 2)));
    }
    next.best_frequency_Hz             = 1.6;
    next.best_interval_ratio           = 0.87;
    next.most_informative_frequency_Hz = 0.5;
    return next;
  }

  inline CalibrationResult synthetic_calibration(const int n_parameters = 3)
  {
    std::mt19937      noise(1);
    CalibrationResult result;
    result.status                    = "converged";
    result.chi_squared               = 21.4;
    result.misfit                    = 9.87;
    result.n_observations            = 24;
    result.n_degrees_of_freedom      = 24 - n_parameters;
    result.kkt_residual              = 3e-9;
    result.loss                      = "least-squares";
    result.swimmer.young_modulus_Pa  = 8e4;
    result.swimmer.viscosity_Pa_s    = 1.52;
    result.swimmer.magnetization_A_m = 2e5;
    const std::vector<CalibratedParameter> all{
        synthetic_parameter("young_modulus_over_viscosity_1_s", 52631.6, 0.012),
        synthetic_parameter("magnetization_over_viscosity_A_m_Pa_s", 131579., 0.014),
        synthetic_parameter("displacement_scale", 1.003, 0.017)};
    result.parameters.assign(all.begin(), all.begin() + n_parameters);
    add_synthetic_set(result, "soft", 0.6, noise);
    add_synthetic_set(result, "stiff", 0.85, noise);
    add_synthetic_starts(result, noise);
    for (const CalibratedParameter &parameter : result.parameters)
      add_synthetic_profile(result, parameter);
    add_synthetic_bootstrap(result, noise);
    result.next                       = synthetic_next();
    result.discrepancy.relative_size  = 0.007;
    result.discrepancy.origin         = "held-out runs";
    result.discrepancy.checks         = {{"soft", 0.58, 1.86e-4, 1.87e-4}, {"soft", 1.7, 1.10e-4, 1.09e-4}};
    result.discrepancy.verdict        = "Three full-order runs at the optimum leave the estimate where it is.";
    result.model_file                 = "reference-2d.h5";
    result.scene_name                 = "reference-2d-casefile";
    result.data_files                 = {"soft.csv", "stiff.csv"};
    result.problem_text               = "data = [\"soft.csv\", \"stiff.csv\"]\n";
    result.integrator_tolerance       = 1e-6;
    result.provenance.program_version = "swimtwin 0.1.0";
    return result;
  }
} // namespace swimtwin
