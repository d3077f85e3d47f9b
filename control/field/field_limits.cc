#include <control/field/field_limits.h>

#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int arcs_per_harmonic = 12, samples_per_arc = 4;
  }

  LimitedField::LimitedField(const FourierField &field, const FieldLimits &limits)
      : field_(field), n_arcs_(arcs_per_harmonic * field.series().n_harmonics())
  {
    const auto add = [&](const std::string &name, const Eigen::MatrixXd &matrix, const double bound, const char *unit,
                         const bool of_rate) {
      if (!std::isfinite(bound))
        return;
      bounds_.push_back({name, matrix, bound, of_rate});
      for (int arc = 0; arc < n_arcs_; ++arc)
        names_.push_back(
            fmt::format("{} <= {:.4g} {} near phase {:.3f}", name, bound, unit, static_cast<double>(arc) / n_arcs_));
    };
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(limits.turn_rad).toRotationMatrix();
    add("|B|", Eigen::Matrix2d::Identity(), limits.magnitude_T, "T", false);
    add("|bx|", turn.row(0), limits.component_T[0], "T", false);
    add("|by|", turn.row(1), limits.component_T[1], "T", false);
    add("|dB/dt|", Eigen::Matrix2d::Identity(), limits.slew_rate_T_s, "T/s", true);
    for (Eigen::Index coil = 0; coil < limits.current_per_field_A_T.rows(); ++coil)
      add(fmt::format("current of coil {}", coil + 1), limits.current_per_field_A_T.row(coil) * turn, limits.current_A,
          "A", false);
  }

  Eigen::VectorXd LimitedField::limited(const Bound &bound, const double phase, const Eigen::VectorXd &coefficients,
                                        const double frequency_Hz) const
  {
    const auto           &series = field_.series();
    const Eigen::Vector2d v =
        bound.of_rate ? (frequency_Hz * series.rate(phase, coefficients)).eval() : series.value(phase, coefficients);
    return bound.matrix * v / bound.bound;
  }

  double LimitedField::value(const Bound &bound, const double phase, const Eigen::VectorXd &coefficients,
                             const double frequency_Hz) const
  {
    return limited(bound, phase, coefficients, frequency_Hz).squaredNorm() - 1.;
  }

  Eigen::RowVectorXd LimitedField::slopes(const Bound &bound, const double phase, const Eigen::VectorXd &coefficients,
                                          const double frequency_Hz) const
  {
    const auto           &series = field_.series();
    const Eigen::VectorXd v      = limited(bound, phase, coefficients, frequency_Hz);
    const Eigen::MatrixXd by_coefficients =
        bound.of_rate ? (frequency_Hz * series.rate_slopes(phase)).eval() : series.slopes(phase);
    Eigen::RowVectorXd row(coefficients.size() + 1);
    row.head(coefficients.size()) = 2. / bound.bound * v.transpose() * bound.matrix * by_coefficients;
    row[coefficients.size()]      = bound.of_rate ? 2. * v.squaredNorm() / frequency_Hz : 0.;
    return row;
  }

  double LimitedField::peak(const Bound &bound, const int arc, const Eigen::VectorXd &coefficients,
                            const double frequency_Hz) const
  {
    const double step = 1. / (n_arcs_ * samples_per_arc), begin = static_cast<double>(arc) / n_arcs_;
    const auto   negative = [&](const double phase) { return -value(bound, phase, coefficients, frequency_Hz); };
    int          best     = 0;
    double       lowest   = negative(begin);
    for (int i = 1; i <= samples_per_arc; ++i)
      if (const double here = negative(begin + i * step); here < lowest)
      {
        lowest = here;
        best   = i;
      }
    if (best == 0 || best == samples_per_arc) // the neighbouring arc's, or the arc's end
    {
      // So near that a peak between the two is no higher than the arc's end, but for a part in 1e6 of its curvature.
      constexpr double near   = 1e-3;
      const double     inward = begin + (best == 0 ? near : samples_per_arc - near) * step;
      if (negative(inward) >= lowest)
        return begin + best * step;
    }
    constexpr int bits        = 24; // half the digits of the place give all those of the value
    const auto [place, found] = boost::math::tools::brent_find_minima(
        negative, begin + std::max(0, best - 1) * step, begin + std::min(samples_per_arc, best + 1) * step, bits);
    return found < lowest ? place : begin + best * step;
  }

  LimitValues LimitedField::evaluate(const Eigen::VectorXd &coefficients, const double frequency_Hz) const
  {
    LimitValues limits{Eigen::VectorXd(size()), Eigen::MatrixXd(size(), coefficients.size() + 1)};
    int         row = 0;
    for (const Bound &bound : bounds_)
      for (int arc = 0; arc < n_arcs_; ++arc, ++row)
      {
        const double phase     = peak(bound, arc, coefficients, frequency_Hz);
        limits.values[row]     = value(bound, phase, coefficients, frequency_Hz);
        limits.slopes.row(row) = slopes(bound, phase, coefficients, frequency_Hz);
      }
    return limits;
  }

  double LimitedField::largest_of(const int n, const Eigen::VectorXd &coefficients, const double frequency_Hz) const
  {
    double largest = -std::numeric_limits<double>::infinity();
    for (const Bound &bound : bounds_)
      for (int i = 0; i < n; ++i)
        largest = std::max(largest, value(bound, static_cast<double>(i) / n, coefficients, frequency_Hz));
    return largest;
  }
} // namespace swimtwin
