#include <control/field/fourier_field.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr const char *components[] = {"bx", "by", "bz"};
  }

  FourierField::FourierField(const int n_harmonics) : series_(n_harmonics)
  {
    if (n_harmonics < 1)
      throw InputError(fmt::format("a field of {} harmonics cannot swing; give at least 1.", n_harmonics));
  }

  std::vector<std::string> FourierField::parameter_names() const
  {
    std::vector<std::string> names;
    for (int c = 0; c < 2; ++c)
    {
      names.push_back(fmt::format("{}_bias_T", components[c]));
      for (int k = 1; k <= series_.n_harmonics(); ++k)
        for (const char *part : {"cos", "sin"})
          names.push_back(fmt::format("{}_{}_{}_T", components[c], part, k));
    }
    return names;
  }

  Eigen::Vector2d FourierField::value_T(const double phase, const Eigen::VectorXd &parameters) const
  {
    return series_.value(phase, parameters);
  }

  Eigen::Matrix2Xd FourierField::slopes(const double phase, const Eigen::VectorXd & /*parameters*/) const
  {
    return series_.slopes(phase);
  }

  Eigen::VectorXd sinusoid_coefficients(const FourierField &field, const double bx_T, const double by_T)
  {
    Eigen::VectorXd coefficients            = Eigen::VectorXd::Zero(field.series().n_coefficients());
    coefficients[field.series().bias(0)]    = bx_T;
    coefficients[field.series().sine(1, 1)] = by_T;
    return coefficients;
  }

  Eigen::VectorXd with_harmonics(const FourierField &from, const Eigen::VectorXd &coefficients, const FourierField &to)
  {
    const auto     &a = from.series(), &b = to.series();
    const int       n      = 2 * std::min(a.n_harmonics(), b.n_harmonics()) + 1;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(b.n_coefficients());
    for (int c = 0; c < 2; ++c)
      result.segment(b.bias(c), n) = coefficients.segment(a.bias(c), n);
    return result;
  }

  Eigen::VectorXd fitted_coefficients(const FourierField &field, const Drive &drive)
  {
    const int       n      = std::max(512, 32 * field.series().n_harmonics());
    Eigen::VectorXd result = Eigen::VectorXd::Zero(field.series().n_coefficients());
    for (int i = 0; i < n; ++i)
    {
      const double phase = static_cast<double>(i) / n;
      result += field.series().slopes(phase).transpose() * drive.field->value_T(phase, drive.parameters) * (2. / n);
    }
    for (int c = 0; c < 2; ++c)
      result[field.series().bias(c)] /= 2.;
    return result;
  }
} // namespace swimtwin
