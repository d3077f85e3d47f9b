#include <reports/fit/parameter_axis.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// 1, 2 or 5 times a power of ten: the first with no more than `n_most` steps in the span.
    double tick_step(const Span &span, const double n_most)
    {
      const double width = span.high - span.low;
      if (!(width > 0.))
        return 1.;
      const double decade = std::pow(10., std::floor(std::log10(width / n_most)));
      for (const double factor : {1., 2., 5.})
        if (width / (factor * decade) <= n_most)
          return factor * decade;
      return 10. * decade;
    }
  } // namespace

  void Span::include(const double value)
  {
    if (std::isfinite(value))
      low = std::min(low, value), high = std::max(high, value);
  }

  Span widened(const Span &span, const double part)
  {
    const double width = span.high > span.low ? span.high - span.low : 0.1 * std::max(std::abs(span.low), 1e-12);
    return {span.low - part * width, span.high + part * width};
  }

  void set_parameter_axis(GnuplotPicture &picture, const std::size_t k, const ShownQuantity &shown, const Span &span,
                          const double n_ticks)
  {
    picture.set_text(fmt::format("name_{}", k), shown.label());
    picture.set_flag(fmt::format("logarithmic_{}", k), span.low > 0. && span.high > 10. * span.low);
    picture.set(fmt::format("low_{}", k), span.low);
    picture.set(fmt::format("high_{}", k), span.high);
    picture.set(fmt::format("step_{}", k), tick_step(span, n_ticks));
  }
} // namespace swimtwin
