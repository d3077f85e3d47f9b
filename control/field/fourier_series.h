// A periodic vector function as bias and harmonics, with any number of components.
#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  /// Coefficients of one component stand together: bias, then cosine and sine of each harmonic.
  template <int n_components>
  class FourierSeries
  {
  public:
    using Vector = Eigen::Matrix<double, n_components, 1>;
    using Slopes = Eigen::Matrix<double, n_components, Eigen::Dynamic>;

    explicit FourierSeries(const int n_harmonics) : n_harmonics_(n_harmonics) {}

    int n_harmonics() const { return n_harmonics_; }
    int n_coefficients() const { return n_components * per_component(); }

    int bias(const int component) const { return component * per_component(); }
    /// Harmonics count from 1.
    int cosine(const int component, const int harmonic) const { return bias(component) + 2 * harmonic - 1; }
    int sine(const int component, const int harmonic) const { return bias(component) + 2 * harmonic; }

    Vector value(const double phase, const Eigen::VectorXd &coefficients) const
    {
      return of_components(basis(phase), coefficients);
    }

    /// d value / d phase.
    Vector rate(const double phase, const Eigen::VectorXd &coefficients) const
    {
      return of_components(basis_rate(phase), coefficients);
    }

    /// d value / d coefficients.
    Slopes slopes(const double phase) const { return spread(basis(phase)); }
    Slopes rate_slopes(const double phase) const { return spread(basis_rate(phase)); }

  private:
    int per_component() const { return 2 * n_harmonics_ + 1; }

    Eigen::RowVectorXd basis(const double phase) const
    {
      Eigen::RowVectorXd values(per_component());
      values[0] = 1.;
      for (int k = 1; k <= n_harmonics_; ++k)
      {
        values[2 * k - 1] = std::cos(2. * std::numbers::pi * k * phase);
        values[2 * k]     = std::sin(2. * std::numbers::pi * k * phase);
      }
      return values;
    }

    Eigen::RowVectorXd basis_rate(const double phase) const
    {
      Eigen::RowVectorXd values(per_component());
      values[0] = 0.;
      for (int k = 1; k <= n_harmonics_; ++k)
      {
        const double omega = 2. * std::numbers::pi * k;
        values[2 * k - 1]  = -omega * std::sin(omega * phase);
        values[2 * k]      = omega * std::cos(omega * phase);
      }
      return values;
    }

    Vector of_components(const Eigen::RowVectorXd &basis, const Eigen::VectorXd &coefficients) const
    {
      Vector v;
      for (int c = 0; c < n_components; ++c)
        v[c] = basis.dot(coefficients.segment(bias(c), per_component()));
      return v;
    }

    Slopes spread(const Eigen::RowVectorXd &basis) const
    {
      Slopes columns = Slopes::Zero(n_components, n_coefficients());
      for (int c = 0; c < n_components; ++c)
        columns.row(c).segment(bias(c), per_component()) = basis;
      return columns;
    }

    int n_harmonics_;
  };
} // namespace swimtwin
