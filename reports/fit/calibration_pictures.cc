#include <reports/fit/calibration_pictures.h>

#include <reports/fit/calibration_scripts.h>
#include <reports/fit/fitted_quantity.h>
#include <reports/fit/pairs_picture.h>
#include <reports/fit/profiles_picture.h>
#include <reports/fit/waterfall_picture.h>
#include <reports/page/frequency_axis.h>
#include <reports/page/number_text.h>
#include <reports/page/shown_units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using Residuals = std::vector<ObservationResidual>;

    std::vector<std::string> data_sets(const CalibrationResult &result)
    {
      std::vector<std::string> names;
      for (const ObservationResidual &residual : result.residuals)
        if (std::find(names.begin(), names.end(), residual.data_set) == names.end())
          names.push_back(residual.data_set);
      return names;
    }

    Residuals residuals_of(const CalibrationResult &result, const std::string &data_set)
    {
      Residuals some;
      for (const ObservationResidual &residual : result.residuals)
        if (residual.data_set == data_set)
          some.push_back(residual);
      return some;
    }

    const PredictionBand *band_of(const CalibrationResult &result, const std::string &data_set)
    {
      for (const PredictionBand &band : result.bands)
        if (band.data_set == data_set && !band.frequency_Hz.empty())
          return &band;
      return nullptr;
    }

    /// Data of a factor of four need a logarithm.
    void set_frequency_axis(GnuplotPicture &picture, const double lowest_Hz, const double highest_Hz)
    {
      FrequencyAxis{.lowest_Hz = lowest_Hz, .highest_Hz = highest_Hz, .logarithmic_above = 4., .margin = 1.1}.set_in(
          picture);
    }

    void set_axis_of_observations(GnuplotPicture &picture, const CalibrationResult &result)
    {
      double lowest = result.residuals.front().frequency_Hz, highest = lowest;
      for (const ObservationResidual &residual : result.residuals)
      {
        lowest  = std::min(lowest, residual.frequency_Hz);
        highest = std::max(highest, residual.frequency_Hz);
      }
      for (const PredictionBand &band : result.bands)
        for (const double frequency : band.frequency_Hz)
        {
          lowest  = std::min(lowest, frequency);
          highest = std::max(highest, frequency);
        }
      set_frequency_axis(picture, lowest, highest);
    }

    /// The end of a band, or the curve itself where none was computed.
    double end_or_curve(const std::vector<double> &ends, const PredictionBand &band, const std::size_t i)
    {
      return mm * (i < ends.size() && std::isfinite(ends[i]) ? ends[i] : band.value[i]);
    }

    void add_curve(GnuplotPicture &picture, const PredictionBand *band, const Residuals &residuals)
    {
      picture.table.begin_block("frequency (Hz), curve (mm), its band (mm, mm), band of observations (mm, mm)");
      if (band == nullptr)
        for (const ObservationResidual &r : residuals)
        {
          const double predicted = mm * r.predicted;
          picture.table.add_row({r.frequency_Hz, predicted, predicted, predicted, predicted, predicted});
        }
      else
        for (std::size_t i = 0; i < band->frequency_Hz.size(); ++i)
          picture.table.add_row({band->frequency_Hz[i], mm * band->value[i], end_or_curve(band->low, *band, i),
                                 end_or_curve(band->high, *band, i), end_or_curve(band->observation_low, *band, i),
                                 end_or_curve(band->observation_high, *band, i)});
    }

    void add_observations(GnuplotPicture &picture, const Residuals &residuals)
    {
      picture.table.begin_block("frequency (Hz), observed (mm), sigma (mm), weight");
      for (const ObservationResidual &r : residuals)
        picture.table.add_row({r.frequency_Hz, mm * r.observed, mm * r.sigma, r.weight});
      picture.table.begin_block("frequency (Hz), standardised residual, weight");
      for (const ObservationResidual &r : residuals)
        picture.table.add_row({r.frequency_Hz, r.standardised, r.weight});
    }

    void set_residual_axis(GnuplotPicture &picture, const Residuals &residuals)
    {
      double largest = 2.;
      for (const ObservationResidual &r : residuals)
        if (std::isfinite(r.standardised))
          largest = std::max(largest, std::abs(r.standardised));
      picture.set("r_max", 1.15 * largest);
      picture.set("r_step", largest < 4. ? 1. : std::ceil(largest / 4.));
      picture.set_flag("has_outliers", std::any_of(residuals.begin(), residuals.end(),
                                                   [](const ObservationResidual &r) { return r.weight < 0.5; }));
    }

    std::string caption_of_fit(const CalibrationResult &result)
    {
      const std::string bands = result.bands.empty() ? ""
                                                     : fmt::format("; bands: {} of the curve, and of a new observation",
                                                                   level_text(result.level));
      return fmt::format("{}; χ² = {} with {} degrees of freedom{}", result.status, plain_number(result.chi_squared, 3),
                         result.n_degrees_of_freedom, bands);
    }

    void add_gains(GnuplotPicture &picture, const NextExperiment &next)
    {
      picture.table.begin_block("frequency (Hz), interval (% of today's), gain of information");
      for (std::size_t i = 0; i < next.frequency_Hz.size(); ++i)
        picture.table.add_row({next.frequency_Hz[i], 100. * next.interval_ratio[i],
                               i < next.information_gain.size() ? next.information_gain[i] : 0.});
      picture.table.begin_block("best for the parameter: frequency (Hz), interval (% of today's)");
      picture.table.add_row({next.best_frequency_Hz, 100. * next.best_interval_ratio});
      const auto most = std::max_element(next.information_gain.begin(), next.information_gain.end());
      picture.table.begin_block("most informative: frequency (Hz), gain of information");
      picture.table.add_row({next.most_informative_frequency_Hz, most == next.information_gain.end() ? 0. : *most});
    }
  } // namespace

  GnuplotPicture fit_picture(const CalibrationResult &result)
  {
    GnuplotPicture picture =
        titled_picture("fit", calibration_scripts::fit, "Fit to displacement per period", caption_of_fit(result));
    set_axis_of_observations(picture, result);
    set_residual_axis(picture, result.residuals);
    const std::vector<std::string> names = data_sets(result);
    picture.set("n_sets", static_cast<double>(names.size()));
    for (std::size_t k = 0; k < names.size(); ++k)
    {
      const Residuals residuals = residuals_of(result, names[k]);
      picture.set_text(fmt::format("name_{}", k), names[k]);
      add_curve(picture, band_of(result, names[k]), residuals);
      add_observations(picture, residuals);
    }
    return picture;
  }

  GnuplotPicture next_experiment_picture(const CalibrationResult &result)
  {
    const NextExperiment &next    = *result.next;
    const ShownQuantity   shown   = shown_quantity(next.parameter, 1.);
    GnuplotPicture        picture = titled_picture(
               "next_experiment", calibration_scripts::next_experiment, "What one more observation would bring",
               fmt::format("best at {} Hz: the interval of {} shrinks to {} %", plain_number(next.best_frequency_Hz, 3),
                           shown.symbol, plain_number(100. * next.best_interval_ratio, 3)));
    picture.set_text("interval_label", fmt::format("interval of {} (% of today's)", shown.symbol));
    set_frequency_axis(picture, next.frequency_Hz.front(), next.frequency_Hz.back());
    add_gains(picture, next);
    picture.table.begin_block("observed so far: frequency (Hz)");
    for (const ObservationResidual &residual : result.residuals)
      picture.table.add_row({residual.frequency_Hz});
    return picture;
  }

  std::vector<GnuplotPicture> calibration_pictures(const CalibrationResult &result)
  {
    std::vector<GnuplotPicture> pictures;
    if (!result.residuals.empty())
      pictures.push_back(fit_picture(result));
    if (!result.profiles.empty())
      pictures.push_back(profiles_picture(result));
    if (has_pairs(result))
      pictures.push_back(pairs_picture(result));
    if (result.starts.size() > 1)
      pictures.push_back(waterfall_picture(result));
    if (result.next && result.next->frequency_Hz.size() > 1)
      pictures.push_back(next_experiment_picture(result));
    return pictures;
  }
} // namespace swimtwin
