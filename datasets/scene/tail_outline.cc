#include <datasets/scene/tail_outline.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using Points = std::vector<std::array<double, 2>>;

    double width(const Points &points, const std::size_t i)
    {
      return points[i + 1][0] - points[i][0];
    }
    double slope(const Points &points, const std::size_t i)
    {
      return (points[i + 1][1] - points[i][1]) / width(points, i);
    }

    /// Of the parabola through three points at the first of them, limited so that the curve does not turn back.
    double derivative_at_end(const double h0, const double h1, const double s0, const double s1)
    {
      const double d = ((2. * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
      if (d * s0 <= 0.)
        return 0.;
      return s0 * s1 <= 0. && std::abs(d) > 3. * std::abs(s0) ? 3. * s0 : d;
    }

    double derivative(const Points &points, const std::size_t i)
    {
      const std::size_t last = points.size() - 1;
      if (last == 1)
        return slope(points, 0);
      if (i == 0)
        return derivative_at_end(width(points, 0), width(points, 1), slope(points, 0), slope(points, 1));
      if (i == last)
        return derivative_at_end(width(points, last - 1), width(points, last - 2), slope(points, last - 1),
                                 slope(points, last - 2));
      const double before = slope(points, i - 1), after = slope(points, i);
      if (before * after <= 0.)
        return 0.;
      const double h0 = width(points, i - 1), h1 = width(points, i), w0 = 2. * h1 + h0, w1 = h1 + 2. * h0;
      return (w0 + w1) / (w0 / before + w1 / after);
    }
  } // namespace

  double monotone_interpolation(const Points &points, const double x)
  {
    const auto        beyond = std::upper_bound(points.begin() + 1, points.end() - 1, x,
                                                [](const double value, const auto &point) { return value < point[0]; });
    const std::size_t i      = beyond - points.begin() - 1;
    const double      h = width(points, i), t = std::clamp((x - points[i][0]) / h, 0., 1.), s = 1. - t;
    return s * s * (1. + 2. * t) * points[i][1] + t * t * (1. + 2. * s) * points[i + 1][1] +
           h * t * s * (s * derivative(points, i) - t * derivative(points, i + 1));
  }

  double TailOutline::half_height_m(const double x_m) const
  {
    return monotone_interpolation(sides, x_m);
  }

  TailOutline tail_outline(const Head &head, const Tail &tail)
  {
    const double a      = 0.5 * head.size_m[0];
    const double height = std::min(1., tail.root_height_m / head.size_m[1]);
    TailOutline  outline;
    outline.x_root_m = head.shape == HeadShape::rectangle ? a : a * std::sqrt(1. - height * height);
    outline.x_tip_m  = a + tail.length_m;
    outline.x_end_m  = outline.x_tip_m - (tail.tip == TipShape::rounded ? 0.5 * tail.tip_height_m : 0.);
    for (const auto &[x, half_height] : tail.profile_m)
      outline.sides.push_back({a + x, half_height});
    if (tail.profile_m.empty())
      outline.sides.resize(2);
    outline.sides.front() = {outline.x_root_m, 0.5 * tail.root_height_m};
    outline.sides.back()  = {outline.x_end_m, 0.5 * tail.tip_height_m};
    return outline;
  }
} // namespace swimtwin
