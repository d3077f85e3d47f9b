#include <fom/surface/revolved_surface.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace swimtwin
{
  using namespace dealii;
  using std::numbers::pi;

  namespace
  {
    /// A conformal map of the half surface of one curve to the plane. Beside the axis, arc length over radius, u, and
    /// the angle about the axis are plane coordinates with equal scales; where the curve begins on the axis, exp(u) and
    /// the angle are polar ones.
    class ConformalChart
    {
    public:
      ConformalChart(PlanarCurve curve, const double on_axis_m)
          : curve_(std::move(curve)), has_pole_(curve_.position(0.)[1] <= on_axis_m)
      {
        const double dt = 1. / n_pieces;
        u_.push_back(0.);
        for (int i = 0; i < n_pieces; ++i) // midpoint and two more: Gauss' rule of three points
          u_.push_back(
              u_.back() +
              dt * (5. * slope((i + .5 - gauss) * dt) + 8. * slope((i + .5) * dt) + 5. * slope((i + .5 + gauss) * dt)) /
                  18.);
        scale_ = has_pole_ ? curve_.position(1.)[1] : .5 * (curve_.position(0.)[1] + curve_.position(1.)[1]);
      }

      Point<2> chart(const double t, const double angle) const
      {
        const double u = interpolate(t);
        if (!has_pole_)
          return {scale_ * u, scale_ * angle};
        const double rho = scale_ * t * std::exp(u - u_.back());
        return {rho * std::cos(angle), angle == pi ? 0. : rho * std::sin(angle)};
      }

      /// Parameter of the curve and angle at a point of the chart.
      std::array<double, 2> parameters(const Point<2> &p) const
      {
        const double wanted = has_pole_ ? p.norm() : p[0];
        double       low = 0., high = 1.;
        for (int i = 0; i < 50; ++i)
          (along(.5 * (low + high)) < wanted ? low : high) = .5 * (low + high);
        return {.5 * (low + high), has_pole_ ? std::atan2(p[1], p[0]) : p[1] / scale_};
      }

      /// Lengths in the chart over lengths on the surface.
      double magnification(const double t) const
      {
        const double r = curve_.position(t)[1];
        return !has_pole_ ? scale_ / r : t > 1e-6 ? along(t) / r : along(1e-6) / curve_.position(1e-6)[1];
      }

      bool     has_pole() const { return has_pole_; }
      Point<2> meridian(const double t) const { return curve_.position(t); }

    private:
      static constexpr int    n_pieces = 400;
      static constexpr double gauss    = 0.38729833462074168852; // sqrt(3/5) / 2

      /// du/dt; at a pole less 1/t, which leaves something smooth.
      double slope(const double t) const
      {
        constexpr double h = 1e-5;
        const double     a = std::max(0., t - h), b = std::min(1., t + h);
        const double     speed = curve_.position(b).distance(curve_.position(a)) / (b - a);
        return speed / curve_.position(t)[1] - (has_pole_ ? 1. / t : 0.);
      }
      double interpolate(const double t) const
      {
        const int    i     = std::clamp(int(t * n_pieces), 0, n_pieces - 1);
        const double share = t * n_pieces - i;
        return (1. - share) * u_[i] + share * u_[i + 1];
      }
      /// The chart's coordinate along the meridian.
      double along(const double t) const { return chart(t, 0.)[0]; }

      PlanarCurve         curve_;
      bool                has_pole_;
      std::vector<double> u_;
      double              scale_ = 1.;
    };

    PlanarCurve part(const PlanarCurve &curve, const double from, const double to)
    {
      return {[=](const double t) { return curve.position(from + t * (to - from)); }};
    }

    /// Edges of at most a tenth of a turn about the centre of curvature across the meridian, r / n_r with the radial
    /// component n_r of the normal: longer quadratic ones fold their elements.
    class CurvatureLimit
    {
    public:
      CurvatureLimit(const PlanarCurve &curve, const double on_axis_m)
      {
        for (int i = 0; i <= n_samples; ++i)
        {
          constexpr double h = 1e-4;
          const double     t = double(i) / n_samples, a = std::max(0., t - h), b = std::min(1., t + h);
          const Point<2>   x        = curve.position(t);
          const auto       along    = curve.position(b) - curve.position(a);
          const double     n_radial = std::abs(along[0]) / along.norm();
          samples_.emplace_back(x, pi / 5. * std::max(x[1], on_axis_m) / std::max(n_radial, 1e-12));
        }
        // At a pole both radius and component vanish: what is beside it counts.
        if (samples_.front().first[1] <= on_axis_m)
          samples_.front().second = samples_[1].second;
        if (samples_.back().first[1] <= on_axis_m)
          samples_.back().second = samples_[n_samples - 1].second;
      }
      double operator()(const Point<2> &x) const
      {
        return std::min_element(samples_.begin(), samples_.end(),
                                [&](const auto &a, const auto &b) {
                                  return a.first.distance_square(x) < b.first.distance_square(x);
                                })
            ->second;
      }

    private:
      static constexpr int                     n_samples = 200;
      std::vector<std::pair<Point<2>, double>> samples_;
    };

    /// Radii below this are none: sines of half turns are not zero.
    double radius_of_axis(const std::vector<PlanarCurve> &pieces)
    {
      constexpr double round_off = 1e-9;
      double           largest   = 0.;
      for (const auto &piece : pieces)
        for (const double t : {0., .25, .5, .75, 1.})
          largest = std::max(largest, piece.position(t)[1]);
      return round_off * largest;
    }

    /// Where to divide a curve off the axis whose ends have radii so far apart that charts and divisions, which take
    /// equal steps of its parameter, do not see the thin one.
    std::optional<double> parameter_between_radii(const PlanarCurve &curve, const double on_axis_m)
    {
      constexpr double far_apart = 50.;
      const double     r0 = curve.position(0.)[1], r1 = curve.position(1.)[1];
      if (std::min(r0, r1) <= on_axis_m || std::max(r0, r1) <= far_apart * std::min(r0, r1))
        return {};
      double low = 0., high = 1.;
      for (int i = 0; i < 50; ++i)
        ((curve.position(.5 * (low + high))[1] - std::sqrt(r0 * r1)) * (r0 - r1) > 0. ? low : high) = .5 * (low + high);
      return low;
    }

    /// A piece of a meridian as it was divided.
    struct DividedCurve
    {
      PlanarCurve           curve;
      std::vector<double>   parameters; ///< of the nodes
      std::vector<Point<2>> nodes;      ///< (x, r): vertex, middle, vertex, ...

      DividedCurve reversed() const
      {
        DividedCurve backwards{part(curve, 1., 0.), {}, {nodes.rbegin(), nodes.rend()}};
        for (auto t = parameters.rbegin(); t != parameters.rend(); ++t)
          backwards.parameters.push_back(1. - *t);
        return backwards;
      }
    };

    /// Angles of the nodes of a half circle about the axis, ends included: vertex, middle, vertex, ...
    std::vector<double> circle_angles(const Meridian &meridian, const Point<2> &xr)
    {
      const int           n = std::max(5., std::ceil(pi * xr[1] / meridian.size(xr) - 1e-9));
      std::vector<double> angles;
      for (int i = 0; i <= 2 * n; ++i)
        angles.push_back(pi * i / (2 * n));
      return angles;
    }

    class HalfRevolution
    {
    public:
      HalfRevolution(QuadraticSurface &surface, const Meridian &meridian, const double axis_y,
                     const MPI_Comm communicator)
          : surface_(surface), meridian_(meridian), axis_y_(axis_y), communicator_(communicator),
            on_axis_m_(radius_of_axis(meridian.pieces))
      {
      }

      void add_piece(const PlanarCurve &curve, const int number, MeridianTrace &trace)
      {
        const bool ends_on_axis = curve.position(1.)[1] <= on_axis_m_;
        if (curve.position(0.)[1] <= on_axis_m_ && ends_on_axis)
        {
          add_piece(part(curve, 0., .5), number, trace);
          return add_piece(part(curve, .5, 1.), number, trace);
        }
        if (const auto t = parameter_between_radii(curve, on_axis_m_))
        {
          add_piece(part(curve, 0., *t), number, trace);
          return add_piece(part(curve, *t, 1.), number, trace);
        }
        const SizeField size = [this, limit = CurvatureLimit(curve, on_axis_m_)](const Point<2> &xr) {
          return std::min(meridian_.size(xr), limit(xr));
        };
        const DividedCurve piece = divide_piece(curve, size);
        add_patch_of(ends_on_axis ? piece.reversed() : piece, size, number);
        append_trace(piece.nodes, trace);
      }

    private:
      DividedCurve divide_piece(const PlanarCurve &curve, const SizeField &size)
      {
        DividedCurve piece{curve, division(curve, size), {}};
        for (const double t : piece.parameters)
          piece.nodes.push_back(curve.position(t));
        for (auto *end : {&piece.nodes.front(), &piece.nodes.back()})
          if ((*end)[1] <= on_axis_m_)
            (*end)[1] = 0.;
        if (last_)
          piece.nodes.front() = *last_; // bit by bit, whatever sines say
        last_ = piece.nodes.back();
        return piece;
      }

      Point<3> above(const Point<2> &xr) const { return {xr[0], axis_y_ + xr[1], 0.}; }
      Point<3> below(const Point<2> &xr) const { return {xr[0], axis_y_ - xr[1], 0.}; }
      Point<3> position(const Point<2> &xr, const double angle) const
      {
        return {xr[0], axis_y_ + xr[1] * std::cos(angle), xr[1] * std::sin(angle)};
      }

      void append_trace(const std::vector<Point<2>> &nodes, MeridianTrace &trace) const
      {
        for (unsigned int i = trace.above.empty() ? 0 : 1; i < nodes.size(); ++i)
        {
          trace.above.push_back(above(nodes[i]));
          trace.below.push_back(below(nodes[i]));
        }
      }

      /// Append a half circle's nodes, but for its ends, which are on the plane.
      void append_circle(SurfacePatch::Loop &loop, const ConformalChart &chart, const double t, const Point<2> &xr,
                         const bool is_forward) const
      {
        auto angles = circle_angles(meridian_, xr);
        if (!is_forward)
          std::reverse(angles.begin(), angles.end());
        for (unsigned int i = 1; i + 1 < angles.size(); ++i)
          loop.append(chart.chart(t, angles[i]), position(xr, angles[i]));
      }

      /// `nodes` begin at the pole, if there is one.
      void add_patch_of(const DividedCurve &piece, const SizeField &size, const int number)
      {
        const auto &[curve, t, nodes] = piece;
        const ConformalChart chart(curve, on_axis_m_);
        SurfacePatch         patch;
        patch.number = number;
        auto &loop   = patch.loops.emplace_back();
        for (unsigned int i = 0; i < nodes.size(); ++i)
          loop.append(chart.chart(t[i], 0.), above(nodes[i]));
        append_circle(loop, chart, 1., nodes.back(), true);
        for (unsigned int i = nodes.size(); i-- > (chart.has_pole() ? 1 : 0);)
          loop.append(chart.chart(t[i], pi), below(nodes[i]));
        if (!chart.has_pole())
          append_circle(loop, chart, 0., nodes.front(), false);
        patch.position = [=, this](const Point<2> &p) {
          const auto [s, angle] = chart.parameters(p);
          return position(chart.meridian(s), angle);
        };
        patch.size = [=, this](const Point<2> &p) {
          const double s = chart.parameters(p)[0];
          return size(chart.meridian(s)) * chart.magnification(s);
        };
        add_patch(surface_, patch, communicator_);
      }

      QuadraticSurface &surface_;
      const Meridian   &meridian_;
      double            axis_y_;
      MPI_Comm          communicator_;
      double            on_axis_m_;

      std::optional<Point<2>> last_; ///< end of the chain so far
    };
  } // namespace

  std::vector<Point<3>> half_circle(const Meridian &meridian, const Point<2> &xr, const double axis_y_m)
  {
    std::vector<Point<3>> nodes;
    for (const double angle : circle_angles(meridian, xr))
      nodes.emplace_back(xr[0], axis_y_m + xr[1] * std::cos(angle), xr[1] * std::sin(angle));
    nodes.front() = {xr[0], axis_y_m + xr[1], 0.};
    nodes.back()  = {xr[0], axis_y_m - xr[1], 0.};
    return nodes;
  }

  MeridianTrace add_revolved(QuadraticSurface &surface, const Meridian &meridian, const double axis_y_m,
                             const int first_patch, const MPI_Comm communicator)
  {
    HalfRevolution half(surface, meridian, axis_y_m, communicator);
    MeridianTrace  trace;
    for (unsigned int i = 0; i < meridian.pieces.size(); ++i)
      half.add_piece(meridian.pieces[i], first_patch + i, trace);
    return trace;
  }
} // namespace swimtwin
