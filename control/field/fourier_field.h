// Driving fields of a few harmonics.
#pragma once

#include <control/field/fourier_series.h>
#include <rom/swimmer/driving_field.h>

namespace swimtwin
{
  /// Bias and harmonics in the plane; parameters bx_bias_T, bx_cos_1_T, bx_sin_1_T, ..., by_bias_T, ...
  class FourierField : public DrivingField
  {
  public:
    /// Throws InputError for less than one harmonic.
    explicit FourierField(int n_harmonics);

    const FourierSeries<2> &series() const { return series_; }

    std::vector<std::string> parameter_names() const override;
    Eigen::Vector2d          value_T(double phase, const Eigen::VectorXd &parameters) const override;
    Eigen::Matrix2Xd         slopes(double phase, const Eigen::VectorXd &parameters) const override;

  private:
    FourierSeries<2> series_;
  };

  /// B = (bx, by sin 2 pi phase), the reference study's field.
  Eigen::VectorXd sinusoid_coefficients(const FourierField &field, double bx_T, double by_T);
  /// The same field with another number of harmonics: those that are missing are left out.
  Eigen::VectorXd with_harmonics(const FourierField &from, const Eigen::VectorXd &coefficients, const FourierField &to);
  /// The field of another drive, by its first harmonics.
  Eigen::VectorXd fitted_coefficients(const FourierField &field, const Drive &drive);
} // namespace swimtwin
