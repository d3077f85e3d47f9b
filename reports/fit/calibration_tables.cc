#include <reports/fit/calibration_tables.h>

#include <reports/fit/fitted_quantity.h>
#include <reports/page/number_text.h>
#include <reports/page/shown_units.h>
#include <reports/run/run_picture.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    const std::string none = "–";

    std::string role_of(const CalibratedParameter &parameter)
    {
      if (parameter.undetermined)
        return "undetermined";
      if (parameter.at_bound)
        return "at its bound";
      return parameter.role == ParameterRole::free ? "fitted" : "follows";
    }

    std::string prior_of(const CalibratedParameter &parameter, const ShownQuantity &shown)
    {
      if (!parameter.prior_mean || !parameter.prior_standard_deviation)
        return none;
      return fmt::format("{} ± {}", plain_number(shown.factor * *parameter.prior_mean, result_digits),
                         plain_number(shown.factor * *parameter.prior_standard_deviation, rounded_digits));
    }

    std::string bounds_of(const CalibratedParameter &parameter, const ShownQuantity &shown)
    {
      if (parameter.role != ParameterRole::free)
        return none;
      return fmt::format("{} to {}", plain_number(shown.factor * parameter.lower, result_digits),
                         plain_number(shown.factor * parameter.upper, result_digits));
    }

    /// Nothing is claimed for a parameter that the data do not determine.
    std::string interval_cell(const CalibratedParameter &parameter, const ClaimedInterval &interval,
                              const ShownQuantity &shown)
    {
      if (interval.method.empty())
        return none;
      return parameter.undetermined ? "not bounded" : interval_text(interval, shown);
    }

    std::vector<HtmlCell> parameter_row(const CalibratedParameter &parameter)
    {
      const ShownQuantity shown = shown_quantity(parameter.name, parameter.value);
      const bool          known = parameter.standard_error && !parameter.undetermined;
      return {{shown.label()},
              {role_of(parameter)},
              {plain_number(shown.factor * parameter.value, result_digits)},
              {known ? plain_number(shown.factor * *parameter.standard_error, rounded_digits) : none},
              {interval_cell(parameter, parameter.profile, shown)},
              {interval_cell(parameter, parameter.bootstrap, shown)},
              {interval_cell(parameter, parameter.curvature, shown)},
              {bounds_of(parameter, shown)},
              {prior_of(parameter, shown)}};
    }

    std::vector<HtmlCell> quantity_row(const std::string &name, const double value)
    {
      const ShownQuantity shown = shown_quantity(name, value);
      return {{shown.label()}, {plain_number(shown.factor * value, result_digits)}};
    }

    std::vector<HtmlCell> observation_row(const ObservationResidual &r)
    {
      return {{r.data_set},
              {plain_number(r.frequency_Hz, result_digits)},
              {signed_number(mm * r.observed, result_digits)},
              {plain_number(mm * r.sigma, rounded_digits)},
              {signed_number(mm * r.predicted, result_digits)},
              {plain_number(mm * r.model_error, rounded_digits)},
              {signed_number(r.standardised, rounded_digits)},
              {plain_number(r.weight, rounded_digits)},
              {r.trust}};
    }
  } // namespace

  HtmlTable parameter_table(const CalibrationResult &result)
  {
    const std::string level = level_text(result.level);
    HtmlTable table{{"parameter", "", "estimate", "standard error", level + " by profile", level + " by bootstrap",
                     level + " by curvature", "searched", "prior"},
                    {}};
    for (const CalibratedParameter &parameter : result.parameters)
      if (parameter.role != ParameterRole::fixed)
        table.rows.push_back(parameter_row(parameter));
    return table;
  }

  HtmlTable swimmer_table(const CalibratedSwimmer &swimmer)
  {
    return {{},
            {quantity_row("young_modulus_Pa", swimmer.young_modulus_Pa),
             quantity_row("viscosity_Pa_s", swimmer.viscosity_Pa_s),
             quantity_row("magnetization_A_m", swimmer.magnetization_A_m),
             quantity_row("field_scale", swimmer.field_scale), quantity_row("geometry_scale", swimmer.geometry_scale),
             quantity_row("displacement_offset_m", swimmer.displacement_offset_m),
             quantity_row("displacement_scale", swimmer.displacement_scale),
             quantity_row("noise_scale", swimmer.noise_scale)}};
  }

  HtmlTable correlation_table(const CalibrationResult &result)
  {
    HtmlTable                table{{""}, {}};
    std::vector<std::string> names = result.free_names();
    if (static_cast<Eigen::Index>(names.size()) > result.correlation.rows())
      names.erase(std::remove(names.begin(), names.end(), "noise_scale"), names.end());
    const bool matches = static_cast<Eigen::Index>(names.size()) == result.correlation.rows();
    if (names.size() < 2 || !matches || result.correlation.array().isNaN().all())
      return {};
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      table.header.push_back(shown_quantity(names[i], 1.).symbol);
      table.rows.push_back({{shown_quantity(names[i], 1.).symbol}});
      for (Eigen::Index j = 0; j < result.correlation.cols(); ++j)
      {
        const double value = result.correlation(static_cast<Eigen::Index>(i), j);
        table.rows.back().push_back({std::isfinite(value) ? signed_number(value, rounded_digits) : none});
      }
    }
    return table;
  }

  HtmlTable observation_table(const CalibrationResult &result)
  {
    HtmlTable table{{"data", "frequency (Hz)", "observed (mm)", "σ (mm)", "fitted (mm)", "model's own error (mm)",
                     "residual (σ)", "weight", ""},
                    {}};
    for (const ObservationResidual &residual : result.residuals)
      table.rows.push_back(observation_row(residual));
    return table;
  }

  HtmlTable full_order_table(const ModelDiscrepancy &discrepancy)
  {
    HtmlTable table{{"data", "frequency (Hz)", "reduced (mm)", "full order (mm)", "difference (%)"}, {}};
    for (const FullOrderCheck &check : discrepancy.checks)
      table.rows.push_back({{check.data_set},
                            {plain_number(check.frequency_Hz, result_digits)},
                            {signed_number(mm * check.reduced, result_digits)},
                            {signed_number(mm * check.full_order, result_digits)},
                            {signed_number(100. * (check.reduced / check.full_order - 1.), rounded_digits)}});
    return table;
  }

  HtmlTable search_table(const CalibrationResult &result)
  {
    const auto converged = std::count_if(result.starts.begin(), result.starts.end(),
                                         [](const FitStart &start) { return start.status.starts_with("converged"); });
    HtmlTable  table{
        {},
        {{{"loss"}, {result.loss}},
          {{"misfit"}, {plain_number(result.misfit, 6)}},
          {{"χ²"}, {plain_number(result.chi_squared, result_digits)}},
          {{"observations"}, {std::to_string(result.n_observations)}},
          {{"degrees of freedom"}, {std::to_string(result.n_degrees_of_freedom)}},
          {{"residual of the optimality conditions"}, {plain_number(result.kkt_residual, rounded_digits)}},
          {{"starts that converged"}, {fmt::format("{} of {}", converged, result.starts.size())}},
          {{"evaluations"}, {std::to_string(result.n_evaluations)}},
          {{"budget of evaluations per start"}, {std::to_string(result.max_evaluations)}},
          {{"runs of the reduced swimmer"}, {std::to_string(result.n_runs)}},
          {{"relative tolerance of its integrator"}, {plain_number(result.integrator_tolerance, rounded_digits)}},
          {{"time of the fit (s)"}, {plain_number(result.fit_time_s, rounded_digits)}},
          {{"time of its uncertainty (s)"}, {plain_number(result.uncertainty_time_s, rounded_digits)}}}};
    return table;
  }
} // namespace swimtwin
