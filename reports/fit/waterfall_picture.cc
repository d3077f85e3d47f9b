#include <reports/fit/waterfall_picture.h>

#include <reports/fit/calibration_scripts.h>
#include <reports/fit/parameter_axis.h>
#include <reports/page/number_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double same_misfit = 1e-6; // relative

    bool has_converged(const FitStart &start)
    {
      return start.status.starts_with("converged");
    }

    std::string caption(const std::vector<FitStart> &starts)
    {
      const double best    = starts.front().misfit;
      const auto   reached = std::count_if(starts.begin(), starts.end(), [&](const FitStart &start) {
        return start.misfit <= best + same_misfit * std::abs(best) + 1e-9;
      });
      return fmt::format("{} of {} starts reached the best misfit of {}", reached, starts.size(),
                         plain_number(best, 5));
    }

    double tick_step(const double n)
    {
      for (const double step : {1., 2., 5., 10., 20., 50., 100.})
        if (n <= 16. * step)
          return step;
      return std::ceil(n / 16.);
    }

    /// More than a decade is shown by its logarithm.
    void set_misfit_axis(GnuplotPicture &picture, const std::vector<FitStart> &starts)
    {
      Span span{starts.front().misfit, starts.front().misfit};
      for (const FitStart &start : starts)
      {
        span.include(start.misfit);
        span.include(start.misfit_at_start);
      }
      const bool   logarithmic = span.low > 0. && span.high > 10. * span.low;
      const double ratio       = logarithmic ? std::pow(span.high / span.low, 0.06) : 1.;
      const Span   shown       = logarithmic ? Span{span.low / ratio, span.high * ratio} : widened(span, 0.06);
      picture.set_flag("logarithmic", logarithmic);
      picture.set("m_min", shown.low);
      picture.set("m_max", shown.high);
    }
  } // namespace

  GnuplotPicture waterfall_picture(const CalibrationResult &result)
  {
    const std::vector<FitStart> &starts = result.starts;
    GnuplotPicture               picture =
        titled_picture("waterfall", calibration_scripts::waterfall, "Starts and where they ended", caption(starts));
    picture.set("n_starts", static_cast<double>(starts.size()));
    picture.set("tick_step", tick_step(static_cast<double>(starts.size())));
    picture.set_flag("all_converged", std::all_of(starts.begin(), starts.end(), has_converged));
    set_misfit_axis(picture, starts);
    picture.table.begin_block("start, misfit there, misfit reached, 1 if converged");
    for (std::size_t i = 0; i < starts.size(); ++i)
      picture.table.add_row({static_cast<double>(i) + 1., starts[i].misfit_at_start, starts[i].misfit,
                             has_converged(starts[i]) ? 1. : 0.});
    return picture;
  }
} // namespace swimtwin
