#include <rom/swimmer/bspline_field.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    constexpr Eigen::Index n_components = 2; // planar
  }

  std::vector<std::string> BSplineField::parameter_names() const
  {
    std::vector<std::string> names;
    for (Eigen::Index i = 0; i < spline_.n_coefficients(); ++i)
      for (const char *component : {"bx", "by"})
        names.push_back(fmt::format("{}_{}_T", component, i));
    return names;
  }

  Eigen::Vector2d BSplineField::value_T(const double phase, const Eigen::VectorXd &parameters) const
  {
    const UniformSpline::Place place = spline_.value(phase);
    return {UniformSpline::sum(place, parameters, 0, n_components),
            UniformSpline::sum(place, parameters, 1, n_components)};
  }

  Eigen::Vector2d BSplineField::rate_T(const double phase, const Eigen::VectorXd &parameters) const
  {
    const UniformSpline::Place place = spline_.slope(phase);
    return {UniformSpline::sum(place, parameters, 0, n_components),
            UniformSpline::sum(place, parameters, 1, n_components)};
  }

  Eigen::Matrix2Xd BSplineField::slopes(const double phase, const Eigen::VectorXd &parameters) const
  {
    const UniformSpline::Place place  = spline_.value(phase);
    Eigen::Matrix2Xd           slopes = Eigen::Matrix2Xd::Zero(n_components, parameters.size());
    for (std::size_t k = 0; k < UniformSpline::order; ++k)
      slopes.middleCols<n_components>(n_components * place.index[k]) += place.weight[k] * Eigen::Matrix2d::Identity();
    return slopes;
  }

  void BSplineField::pull_back(const double           phase, const Eigen::VectorXd           &/*parameters*/,
                               const Eigen::Vector2d &by_field, Eigen::Ref<Eigen::VectorXd> by_parameters) const
  {
    const UniformSpline::Place place = spline_.value(phase);
    for (std::size_t k = 0; k < UniformSpline::order; ++k)
      by_parameters.segment<n_components>(n_components * place.index[k]) += place.weight[k] * by_field;
  }

  Drive spline_drive(const Drive &drive, const int n_intervals, const bool is_periodic, const int n_periods)
  {
    constexpr int       samples_per_interval = 4;
    const UniformSpline spline(n_intervals, is_periodic);
    const int           n_samples = samples_per_interval * n_intervals + (is_periodic ? 0 : 1);
    Eigen::VectorXd     places(n_samples);
    Eigen::MatrixXd     values(n_samples, n_components);
    for (int i = 0; i < n_samples; ++i)
    {
      places[i]     = static_cast<double>(i) / (samples_per_interval * n_intervals);
      values.row(i) = drive.field->value_T(n_periods * places[i], drive.parameters).transpose();
    }
    const Eigen::MatrixXd coefficients = spline.fit(places, values).transpose();
    return {std::make_shared<BSplineField>(spline), coefficients.reshaped(), drive.frequency_Hz / n_periods};
  }
} // namespace swimtwin
