#include <fom/geometry/planar_curve.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  PlanarCurve PlanarCurve::line(const Point<2> &from, const Point<2> &to)
  {
    return {[=](const double t) { return Point<2>((1. - t) * from + t * Tensor<1, 2>(to)); }};
  }

  PlanarCurve PlanarCurve::graph(std::function<double(double)> height, const double from_x, const double to_x)
  {
    return {[=, height = std::move(height)](const double t) {
      const double x = (1. - t) * from_x + t * to_x;
      return Point<2>(x, height(x));
    }};
  }

  PlanarCurve PlanarCurve::arc(const Point<2> &center, const std::array<double, 2> &radii, const double from_rad,
                               const double to_rad)
  {
    return {[=](const double t) {
      const double phi = from_rad + t * (to_rad - from_rad);
      return center + Tensor<1, 2>({radii[0] * std::cos(phi), radii[1] * std::sin(phi)});
    }};
  }

  namespace
  {
    /// Running integrals along a curve, tabulated finely; inverse() returns the parameter where the integral has a
    /// value.
    class CumulativeIntegral
    {
    public:
      CumulativeIntegral(const PlanarCurve &curve, const std::function<double(const Point<2> &)> &density)
          : value_(n_samples + 1, 0.)
      {
        Point<2> previous = curve.position(0.);
        for (unsigned int i = 1; i <= n_samples; ++i)
        {
          const Point<2> next   = curve.position(double(i) / n_samples);
          const Point<2> middle = curve.position((i - .5) / n_samples);
          value_[i]             = value_[i - 1] + next.distance(previous) * density(middle);
          previous              = next;
        }
      }
      double total() const { return value_.back(); }
      double operator()(const double t) const
      {
        const double       x = std::clamp(t, 0., 1.) * n_samples;
        const unsigned int i = std::min<unsigned int>(x, n_samples - 1);
        return value_[i] + (x - i) * (value_[i + 1] - value_[i]);
      }
      double inverse(const double value) const
      {
        const auto         above = std::upper_bound(value_.begin() + 1, value_.end() - 1, value);
        const unsigned int i     = above - value_.begin();
        return (i - 1 + (value - value_[i - 1]) / (value_[i] - value_[i - 1])) / n_samples;
      }

    private:
      static constexpr unsigned int n_samples = 4000;
      std::vector<double>           value_;
    };
  } // namespace

  std::vector<double> division(const PlanarCurve &curve, const SizeField &size, const unsigned int min_edges)
  {
    const CumulativeIntegral arc_length(curve, [](const Point<2> &) { return 1.; });
    const CumulativeIntegral edges(curve, [&](const Point<2> &x) { return 1. / size(x); });
    const unsigned int       n = std::max<unsigned int>(min_edges, std::ceil(edges.total() - 1e-9));

    std::vector<double> parameter(n + 1, 0.);
    for (unsigned int i = 1; i < n; ++i)
      parameter[i] = edges.inverse(edges.total() * i / n);
    parameter[n] = 1.;

    std::vector<double> with_middles{0.};
    for (unsigned int i = 0; i < n; ++i)
    {
      const double middle = .5 * (arc_length(parameter[i]) + arc_length(parameter[i + 1]));
      with_middles.push_back(arc_length.inverse(middle));
      with_middles.push_back(parameter[i + 1]);
    }
    return with_middles;
  }

  std::vector<Point<2>> divide(const PlanarCurve &curve, const SizeField &size, const unsigned int min_edges)
  {
    std::vector<Point<2>> nodes;
    for (const double t : division(curve, size, min_edges))
      nodes.push_back(curve.position(t));
    return nodes;
  }

  SizeField graded_size(std::vector<std::pair<Point<2>, double>> prescribed, const double growth, const double largest)
  {
    return [prescribed = std::move(prescribed), growth, largest](const Point<2> &x) {
      double size = largest;
      for (const auto &[point, h] : prescribed)
        size = std::min(size, h + growth * point.distance(x));
      return size;
    };
  }
} // namespace swimtwin
