#include <control/steering/steered_field.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr Eigen::Index order = 4; // of a cubic spline

    struct Place
    {
      Eigen::Index              first = 0;
      std::array<double, order> value{}, slope{}; ///< slope per knot interval
    };

    /// The last of n coefficients are held beyond them.
    Place find(const double knots, const Eigen::Index first, const Eigen::Index n)
    {
      const auto   left = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(knots)) - first, 0, n - order);
      const double u = std::clamp(knots - static_cast<double>(left + first), 0., 1.), v = 1. - u;
      return {left,
              {v * v * v / 6., (3. * u * u * u - 6. * u * u + 4.) / 6., (3. * v * v * v - 6. * v * v + 4.) / 6.,
               u * u * u / 6.},
              {-0.5 * v * v, 1.5 * u * u - 2. * u, -1.5 * v * v + 2. * v, 0.5 * u * u}};
    }

    double sum(const std::array<double, order> &weights, const Eigen::VectorXd &coefficients, const Eigen::Index first)
    {
      return Eigen::Map<const Eigen::Vector4d>(weights.data()).dot(coefficients.segment<order>(first));
    }

    Eigen::Vector2d turned(const double angle, const Eigen::Vector2d &v)
    {
      return Eigen::Rotation2Dd(angle) * v;
    }
  } // namespace

  Eigen::Index SteeringPlan::first_coefficient(const double start) const
  {
    return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(start / knot_periods)), 0,
                                    angles_rad.size() - order);
  }

  Eigen::Index SteeringPlan::n_coefficients(const double start, const double end) const
  {
    const auto last = static_cast<Eigen::Index>(std::ceil(end / knot_periods - 1e-9)) + order - 2;
    return std::max(order, std::min(last, angles_rad.size() - 1) - first_coefficient(start) + 1);
  }

  double SteeringPlan::angle_rad(const double periods) const
  {
    const Place place = find(periods / knot_periods, 0, angles_rad.size());
    return sum(place.value, angles_rad, place.first);
  }

  double SteeringPlan::angle_rate(const double periods) const
  {
    const Place place = find(periods / knot_periods, 0, angles_rad.size());
    return sum(place.slope, angles_rad, place.first) / knot_periods;
  }

  Eigen::Vector2d SteeringPlan::field_T(const double periods) const
  {
    return turned(angle_rad(periods), carrier.field->value_T(periods, carrier.parameters));
  }

  double largest_T(const Drive &drive)
  {
    constexpr int n_samples = 400;
    double        largest   = 0.;
    for (int i = 0; i < n_samples; ++i)
      largest = std::max(largest, drive.field->value_T(static_cast<double>(i) / n_samples, drive.parameters).norm());
    return largest;
  }

  double SteeringPlan::largest_field_T() const
  {
    return largest_T(carrier);
  }

  SteeredField::SteeredField(const SteeringPlan &plan, const double start, const double length)
      : carrier_(plan.carrier), background_T_(plan.background_T), knot_periods_(plan.knot_periods), start_(start),
        length_(length), first_(plan.first_coefficient(start)), n_(plan.n_coefficients(start, start + length))
  {
  }

  std::vector<std::string> SteeredField::parameter_names() const
  {
    std::vector<std::string> names;
    for (Eigen::Index i = 0; i < n_; ++i)
      names.push_back(fmt::format("angle_{}_rad", first_ + i));
    return names;
  }

  Eigen::Vector2d SteeredField::value_T(const double phase, const Eigen::VectorXd &parameters) const
  {
    const double t     = start_ + length_ * phase;
    const Place  place = find(t / knot_periods_, first_, n_);
    return background_T_ +
           turned(sum(place.value, parameters, place.first), carrier_.field->value_T(t, carrier_.parameters));
  }

  Eigen::Matrix2Xd SteeredField::slopes(const double phase, const Eigen::VectorXd &parameters) const
  {
    const double          t               = start_ + length_ * phase;
    const Place           place           = find(t / knot_periods_, first_, n_);
    const Eigen::Vector2d b               = value_T(phase, parameters) - background_T_; // what is turned
    const Eigen::Vector2d by_angle        = {-b.y(), b.x()};
    Eigen::Matrix2Xd      slopes          = Eigen::Matrix2Xd::Zero(2, n_);
    slopes.middleCols<order>(place.first) = by_angle * Eigen::Map<const Eigen::RowVector4d>(place.value.data());
    return slopes;
  }

  std::vector<double> SteeredField::kinks() const
  {
    std::vector<double> phases;
    for (const double kink : carrier_.field->kinks())
      for (double period = std::floor(start_); period <= start_ + length_; period += 1.)
        if (const double phase = (period + kink - start_) / length_; phase >= 0. && phase < 1.)
          phases.push_back(phase);
    std::sort(phases.begin(), phases.end());
    return phases;
  }

  Drive window_of(const SteeringPlan &plan, const double start, const double length)
  {
    const auto n = plan.n_coefficients(start, start + length);
    return {std::make_shared<SteeredField>(plan, start, length),
            plan.angles_rad.segment(plan.first_coefficient(start), n), plan.carrier.frequency_Hz / length};
  }
} // namespace swimtwin
