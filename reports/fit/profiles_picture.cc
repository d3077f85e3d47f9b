#include <reports/fit/profiles_picture.h>

#include <reports/fit/calibration_scripts.h>
#include <reports/fit/parameter_axis.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    double estimate_of(const CalibrationResult &result, const ParameterProfile &profile)
    {
      if (const CalibratedParameter *parameter = result.find(profile.name))
        return parameter->value;
      const auto lowest = std::min_element(profile.misfit_increase.begin(), profile.misfit_increase.end());
      return profile.value[static_cast<std::size_t>(lowest - profile.misfit_increase.begin())];
    }

    /// (distance / standard error)^2, distances of a positive parameter counted in its logarithm.
    void add_parabola(GnuplotPicture &picture, const CalibratedParameter *parameter, const Span &span,
                      const double factor)
    {
      constexpr int n_points = 60;
      picture.table.begin_block("parabola of the curvature: value, misfit increase");
      if (parameter == nullptr || !parameter->standard_error || !(*parameter->standard_error > 0.))
        return picture.table.add_row({span.low, std::nan("")});
      for (int i = 0; i <= n_points; ++i)
      {
        const double value = span.low + (span.high - span.low) * i / n_points, true_value = value / factor;
        const bool   log_scale = parameter->logarithmic && true_value > 0. && parameter->value > 0.;
        const double distance =
            log_scale ? parameter->value * std::log(true_value / parameter->value) : true_value - parameter->value;
        picture.table.add_row({value, std::pow(distance / *parameter->standard_error, 2)});
      }
    }

    void add_interval(GnuplotPicture &picture, const CalibratedParameter *parameter, const double factor,
                      const double threshold)
    {
      picture.table.begin_block("ends of the interval: value, misfit increase");
      std::size_t n = 0;
      if (parameter != nullptr)
        for (const std::optional<double> &end : {parameter->profile.low, parameter->profile.high})
          if (end)
          {
            picture.table.add_row({factor * *end, threshold});
            ++n;
          }
      if (n == 0) // gnuplot wants a row
        picture.table.add_row({std::nan(""), threshold});
    }

    /// What is near the threshold or below: the ends of a profile may be far up.
    Span shown_span(const ParameterProfile &profile, const double factor, const double estimate)
    {
      Span span{factor * estimate, factor * estimate};
      for (std::size_t i = 0; i < profile.value.size(); ++i)
        if (profile.misfit_increase[i] < 3. * profile.threshold)
          span.include(factor * profile.value[i]);
      const bool decades = span.low > 0. && span.high > 10. * span.low;
      return decades ? Span{span.low / 1.2, span.high * 1.2} : widened(span, 0.06);
    }

    void add_profile(GnuplotPicture &picture, const CalibrationResult &result, const std::size_t k,
                     const double n_ticks)
    {
      const ParameterProfile    &profile   = result.profiles[k];
      const double               estimate  = estimate_of(result, profile);
      const ShownQuantity        shown     = shown_quantity(profile.name, estimate);
      const CalibratedParameter *parameter = result.find(profile.name);
      const Span                 span      = shown_span(profile, shown.factor, estimate);
      set_parameter_axis(picture, k, shown, span, n_ticks);
      picture.set(fmt::format("threshold_{}", k), profile.threshold);
      picture.table.begin_block(fmt::format("profile of {}: {}, misfit increase", profile.name, shown.label()));
      for (std::size_t i = 0; i < profile.value.size(); ++i)
        picture.table.add_row({shown.factor * profile.value[i], profile.misfit_increase[i]});
      add_parabola(picture, parameter, span, shown.factor);
      add_interval(picture, parameter, shown.factor, profile.threshold);
      picture.table.begin_block("estimate: value, misfit increase");
      picture.table.add_row({shown.factor * estimate, 0.});
    }
  } // namespace

  GnuplotPicture profiles_picture(const CalibrationResult &result)
  {
    GnuplotPicture picture =
        titled_picture("profiles", calibration_scripts::profiles, "Profiles of the misfit",
                       "along each parameter, with all others fitted again; below the dashed line lies its interval");
    picture.set_text("level", level_text(result.level));
    const std::size_t n = result.profiles.size();
    picture.set("n_profiles", static_cast<double>(n));
    for (std::size_t k = 0; k < n; ++k)
      add_profile(picture, result, k, n == 1 ? 8. : 5.);
    return picture;
  }
} // namespace swimtwin
