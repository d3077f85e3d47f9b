#include <reports/sweep/frequency_picture.h>

#include <reports/page/frequency_axis.h>
#include <reports/page/number_text.h>
#include <reports/page/shown_units.h>
#include <reports/sweep/frequency_script.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    const FrequencyCurve &farthest(const std::vector<FrequencyCurve> &curves)
    {
      return *std::max_element(curves.begin(), curves.end(), [](const FrequencyCurve &a, const FrequencyCurve &b) {
        return std::abs(a.peak().displacement_m) < std::abs(b.peak().displacement_m);
      });
    }

    std::string finding(const FrequencyCurve &curve)
    {
      return fmt::format("farthest {} mm per period at {} Hz with {}",
                         signed_number(mm * curve.peak().displacement_m, 4), plain_number(curve.peak().frequency_Hz, 4),
                         curve.name);
    }

    void set_frequency_axis(GnuplotPicture &picture, const std::vector<FrequencyCurve> &curves)
    {
      FrequencyAxis axis{curves.front().points.front().frequency_Hz, curves.front().points.back().frequency_Hz};
      for (const FrequencyCurve &curve : curves)
      {
        axis.lowest_Hz  = std::min(axis.lowest_Hz, curve.points.front().frequency_Hz);
        axis.highest_Hz = std::max(axis.highest_Hz, curve.points.back().frequency_Hz);
      }
      axis.set_in(picture);
    }

    void add_marks(GnuplotPicture &picture, const std::vector<FrequencyCurve> &curves, const FrequencyMarks &marks)
    {
      picture.set_flag("has_marks", !marks.curves.empty());
      picture.set_text("marks", marks.name);
      picture.table.begin_block("other points: frequency (Hz), displacement (mm), curve");
      for (const FrequencyCurve &marked : marks.curves)
        for (std::size_t k = 0; k < curves.size(); ++k)
          if (curves[k].name == marked.name)
            for (const CurvePoint &point : marked.points)
              picture.table.add_row({point.frequency_Hz, mm * point.displacement_m, static_cast<double>(k)});
      if (marks.curves.empty()) // gnuplot wants a row
        picture.table.add_row({1., 0., 0.});
    }

    /// Symbols on every point of a short curve, on some of a long one, and hardly any where marks are to be seen.
    double symbol_interval(const std::vector<FrequencyCurve> &curves, const FrequencyMarks &marks)
    {
      std::size_t longest = 1;
      for (const FrequencyCurve &curve : curves)
        longest = std::max(longest, curve.points.size());
      const double n_symbols = marks.curves.empty() ? 12. : 1.;
      return std::max(1., std::floor(static_cast<double>(longest) / n_symbols));
    }
  } // namespace

  GnuplotPicture frequency_picture(const std::vector<FrequencyCurve> &curves, const std::string &sweep,
                                   const FrequencyMarks &marks)
  {
    GnuplotPicture picture = titled_picture("displacement_frequency", gnuplot_scripts::displacement_frequency,
                                            "Displacement per period against frequency",
                                            fmt::format("{}: {}", sweep, finding(farthest(curves))));
    set_frequency_axis(picture, curves);
    picture.set("every", symbol_interval(curves, marks));
    picture.set("n_curves", static_cast<double>(curves.size()));
    for (std::size_t k = 0; k < curves.size(); ++k)
    {
      picture.set_text(fmt::format("name_{}", k), curves[k].name);
      picture.table.begin_block(fmt::format("{}: frequency (Hz), displacement (mm)", curves[k].name));
      for (const CurvePoint &point : curves[k].points)
        picture.table.add_row({point.frequency_Hz, mm * point.displacement_m});
    }
    picture.table.begin_block("peaks: frequency (Hz), displacement (mm), curve");
    for (std::size_t k = 0; k < curves.size(); ++k)
      picture.table.add_row(
          {curves[k].peak().frequency_Hz, mm * curves[k].peak().displacement_m, static_cast<double>(k)});
    add_marks(picture, curves, marks);
    return picture;
  }
} // namespace swimtwin
