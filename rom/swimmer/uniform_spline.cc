#include <rom/swimmer/uniform_spline.h>

#include <datasets/system/error.h>
#include <rom/swimmer/dense_algebra.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  UniformSpline::UniformSpline(const int n_intervals, const bool is_periodic)
      : n_(n_intervals), is_periodic_(is_periodic)
  {
    const int least = is_periodic ? order : 1;
    if (n_intervals < least)
      throw InputError(fmt::format("a {} spline of {} intervals is not possible; take at least {}.",
                                   is_periodic ? "periodic" : "cubic", n_intervals, least));
  }

  UniformSpline::Interval UniformSpline::find(const double s) const
  {
    const double inside = is_periodic_ ? s - std::floor(s) : std::clamp(s, 0., 1.);
    const int    left   = std::min(static_cast<int>(inside * n_), n_ - 1);
    return {left, inside * n_ - left, inside != s && !is_periodic_};
  }

  UniformSpline::Place UniformSpline::at(const int left) const
  {
    Place place{};
    for (int k = 0; k < order; ++k)
      place.index[static_cast<std::size_t>(k)] = is_periodic_ ? (left + k) % n_ : left + k;
    return place;
  }

  UniformSpline::Place UniformSpline::value(const double s) const
  {
    const auto [left, u, clamp] = find(s);
    const double v              = 1. - u;
    Place        place          = at(left);
    place.weight = {v * v * v / 6., (3. * u * u * u - 6. * u * u + 4.) / 6., (3. * v * v * v - 6. * v * v + 4.) / 6.,
                    u * u * u / 6.};
    return place;
  }

  UniformSpline::Place UniformSpline::slope(const double s) const
  {
    const auto [left, u, clamp] = find(s);
    const double v = 1. - u, scale = clamp ? 0. : n_;
    Place        place = at(left);
    place.weight       = {-0.5 * scale * v * v, scale * (1.5 * u * u - 2. * u), -scale * (1.5 * v * v - 2. * v),
                          0.5 * scale * u * u};
    return place;
  }

  double UniformSpline::sum(const Place &place, const Eigen::VectorXd &coefficients, const Eigen::Index first,
                            const Eigen::Index stride)
  {
    double total = 0.;
    for (std::size_t k = 0; k < order; ++k)
      total += place.weight[k] * coefficients[first + stride * place.index[k]];
    return total;
  }

  Eigen::MatrixXd UniformSpline::fit(const Eigen::VectorXd &places, const Eigen::MatrixXd &values) const
  {
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(places.size(), n_coefficients());
    for (Eigen::Index i = 0; i < places.size(); ++i)
    {
      const Place place = value(places[i]);
      for (std::size_t k = 0; k < order; ++k)
        basis(i, place.index[k]) += place.weight[k];
    }
    return shortest_least_squares(basis, values);
  }
} // namespace swimtwin
