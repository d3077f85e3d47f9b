#include <calibration/uncertainty/parameter_summary.h>

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    CalibratedParameter free_parameter(const FitInput &input, const Estimate &estimate, const int j,
                                       const double factor)
    {
      const FreeParameter &free = input.map.free()[static_cast<std::size_t>(j)];
      const double         x    = estimate.x()[j];
      CalibratedParameter  p;
      p.name             = key_of(free.quantity);
      p.role             = ParameterRole::free;
      p.logarithmic      = free.logarithmic;
      p.value            = input.map.value(j, x);
      p.lower            = free.lower;
      p.upper            = free.upper;
      p.undetermined     = estimate.information.touches_undecided(j);
      p.curvature        = curvature_interval(input, estimate, j, factor);
      const double width = input.map.upper()[j] - input.map.lower()[j];
      p.at_bound         = std::min(x - input.map.lower()[j], input.map.upper()[j] - x) < 1e-6 * width;
      if (!p.undetermined)
        p.standard_error = std::sqrt(estimate.information.covariance(j, j)) * input.map.value_slope(j, x);
      if (free.prior)
      {
        p.prior_mean               = free.prior->mean;
        p.prior_standard_deviation = free.prior->standard_deviation;
      }
      return p;
    }

    /// The scatter's square is distributed as chi^2 over its degrees of freedom.
    CalibratedParameter noise_parameter(const FitInput &input, const Estimate &estimate, const FreeParameter &free)
    {
      const double        n_free = input.data.n() - input.map.size();
      CalibratedParameter p;
      p.name           = key_of(free.quantity);
      p.role           = ParameterRole::free;
      p.value          = estimate.noise_scale;
      p.lower          = free.lower;
      p.upper          = free.upper;
      p.at_bound       = p.value < 1.0001 * p.lower || p.value > 0.9999 * p.upper;
      p.standard_error = p.value / std::sqrt(2. * n_free);
      const boost::math::chi_squared law(n_free);
      const double                   outside = 0.5 * (1. - input.problem.level);
      p.curvature.method                     = "curvature";
      p.curvature.low                        = p.value * std::sqrt(n_free / quantile(law, 1. - outside));
      p.curvature.high                       = p.value * std::sqrt(n_free / quantile(law, outside));
      return p;
    }

    /// d ln quantity / dx.
    Eigen::VectorXd logarithmic_slopes(const FittedQuantity quantity, const Eigen::MatrixXd &slopes)
    {
      switch (quantity)
      {
      case FittedQuantity::young_modulus_over_viscosity:
        return slopes.row(by_young_modulus) - slopes.row(by_viscosity);
      case FittedQuantity::magnetization_over_viscosity:
        return slopes.row(by_magnetization) - slopes.row(by_viscosity);
      case FittedQuantity::young_modulus:
        return slopes.row(by_young_modulus);
      case FittedQuantity::viscosity:
        return slopes.row(by_viscosity);
      case FittedQuantity::magnetization:
        return slopes.row(by_magnetization);
      default:
        return Eigen::VectorXd::Zero(slopes.cols());
      }
    }

    CalibratedParameter other_parameter(const FitInput &input, const Estimate &estimate, const FittedQuantity quantity,
                                        const double factor)
    {
      const Eigen::VectorXd slopes = logarithmic_slopes(quantity, input.map.slopes(estimate.x()));
      CalibratedParameter   p;
      p.name  = key_of(quantity);
      p.value = value_of(quantity, input.map.swimmer(estimate.x()));
      p.role  = slopes.isZero() ? ParameterRole::fixed : ParameterRole::derived;
      if (p.role == ParameterRole::fixed)
        return p;
      const double deviation = estimate.information.standard_deviation(slopes);
      p.undetermined         = !std::isfinite(deviation);
      p.curvature.method     = "curvature";
      if (p.undetermined)
        p.curvature.note = "the data do not see this quantity: it changes along a null direction";
      else
      {
        p.standard_error = p.value * deviation;
        p.curvature.low  = p.value * std::exp(-factor * deviation);
        p.curvature.high = p.value * std::exp(factor * deviation);
      }
      return p;
    }
  } // namespace

  std::vector<CalibratedParameter> summarize_parameters(const FitInput &input, const Estimate &estimate,
                                                        const double factor)
  {
    std::vector<CalibratedParameter> parameters, fixed;
    for (int j = 0; j < input.map.size(); ++j)
      parameters.push_back(free_parameter(input, estimate, j, factor));
    for (const FreeParameter &free : input.problem.free)
      if (free.quantity == FittedQuantity::noise_scale)
        parameters.push_back(noise_parameter(input, estimate, free));
    for (const FittedQuantity quantity : all_fitted_quantities())
    {
      const auto &free = input.problem.free;
      if (std::any_of(free.begin(), free.end(), [&](const FreeParameter &f) { return f.quantity == quantity; }))
        continue;
      CalibratedParameter p = other_parameter(input, estimate, quantity, factor);
      (p.role == ParameterRole::derived ? parameters : fixed).push_back(std::move(p));
    }
    parameters.insert(parameters.end(), fixed.begin(), fixed.end());
    return parameters;
  }
} // namespace swimtwin
