#include <control/field/field_variables.h>

namespace swimtwin
{
  namespace
  {
    constexpr int x = 0, y = 1;

    std::vector<int> free_coefficients(const FourierSeries<2> &series, const FieldFamily family)
    {
      if (family == FieldFamily::sinusoid)
        return {series.bias(x), series.sine(y, 1)};
      std::vector<int> free;
      for (const int component : {x, y})
      {
        const int parity = component == x ? 0 : 1; // of the harmonics that symmetry leaves
        for (int k = 0; k <= series.n_harmonics(); ++k)
        {
          if (family == FieldFamily::symmetric && k % 2 != parity)
            continue;
          if (k > 0 && !(component == y && k == 1))
            free.push_back(series.cosine(component, k));
          free.push_back(k == 0 ? series.bias(component) : series.sine(component, k));
        }
      }
      return free;
    }
  } // namespace

  FieldVariables::FieldVariables(const int n_harmonics, const FieldFamily family)
      : field_(std::make_shared<FourierField>(family == FieldFamily::sinusoid ? 1 : n_harmonics)),
        free_(free_coefficients(field_->series(), family))
  {
  }

  std::vector<std::string> FieldVariables::names() const
  {
    const std::vector<std::string> all = field_->parameter_names();
    std::vector<std::string>       names;
    for (const int i : free_)
      names.push_back(all[static_cast<std::size_t>(i)]);
    names.emplace_back("frequency_Hz");
    return names;
  }

  Eigen::VectorXd FieldVariables::coefficients(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(field_->series().n_coefficients());
    for (std::size_t i = 0; i < free_.size(); ++i)
      all[free_[i]] = x[static_cast<Eigen::Index>(i)];
    return all;
  }

  Drive FieldVariables::drive(const Eigen::VectorXd &x) const
  {
    return {field_, coefficients(x), frequency_Hz(x)};
  }

  Eigen::VectorXd FieldVariables::variables(const Eigen::VectorXd &coefficients, const double frequency_Hz) const
  {
    Eigen::VectorXd x(size());
    for (std::size_t i = 0; i < free_.size(); ++i)
      x[static_cast<Eigen::Index>(i)] = coefficients[free_[i]];
    x[size() - 1] = frequency_Hz;
    return x;
  }

  Eigen::VectorXd FieldVariables::variables(const Drive &drive) const
  {
    return variables(fitted_coefficients(*field_, drive), drive.frequency_Hz);
  }

  Eigen::MatrixXd FieldVariables::slopes(const Eigen::MatrixXd &by_all) const
  {
    Eigen::MatrixXd columns(by_all.rows(), size());
    for (std::size_t i = 0; i < free_.size(); ++i)
      columns.col(static_cast<Eigen::Index>(i)) = by_all.col(free_[i]);
    columns.col(size() - 1) = by_all.col(by_all.cols() - 1);
    return columns;
  }

  std::vector<Parameter> FieldVariables::parameters() const
  {
    std::vector<Parameter> all;
    for (int i = 0; i < field_->series().n_coefficients(); ++i)
      all.push_back({Quantity::field, i});
    all.push_back({Quantity::frequency, 0});
    return all;
  }
} // namespace swimtwin
