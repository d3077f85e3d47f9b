#include <datasets/reduced/reduced_model.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double saturation_width = 0.1;

    /// Amplitudes of the first k of r coordinates and of all followers.
    std::vector<int> kept_amplitudes(const ReducedTail &tail, const int k)
    {
      std::vector<int> kept;
      for (int i = 0; i < tail.n_amplitudes(); ++i)
        if ((tail.amplitudes.are_given() && k > 0) || i < k || i >= tail.n_coordinates())
          kept.push_back(i);
      return kept;
    }

    std::vector<int> features_without_modes_from(const Eigen::MatrixXi &exponents, const int k, const int r)
    {
      std::vector<int> kept;
      for (int f = 0; f < exponents.rows(); ++f)
        if ((exponents.row(f).segment(k, r - k).array() == 0).all())
          kept.push_back(f);
      return kept;
    }

    ShapePolynomials of_leading_coordinates(const ShapePolynomials &all, const int k)
    {
      if (!all.are_given())
        return all;
      const auto kept = features_without_modes_from(all.exponents, k, static_cast<int>(all.exponents.cols()));
      return {all.scale_m.head(k), all.exponents(kept, Eigen::seqN(0, k)), all.coefficients(kept, Eigen::all)};
    }

    ReducedTail leading_modes(ReducedTail tail, const int k)
    {
      const std::vector<int> kept = kept_amplitudes(tail, k);
      tail.modes                  = tail.modes(Eigen::all, kept).eval();
      tail.parity                 = tail.parity(kept).eval();
      if (tail.followers.cols() > 0)
        tail.followers = tail.followers.leftCols(k * (k + 1) / 2).eval();
      tail.amplitudes = of_leading_coordinates(tail.amplitudes, k);
      return tail;
    }

    /// Indices of the strain monomials of some of R amplitudes among those of all.
    std::vector<int> kept_strain_monomials(const int R, const std::vector<int> &amplitudes)
    {
      std::vector<int> kept = amplitudes;
      for (std::size_t i = 0; i < amplitudes.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
          kept.push_back(strain_monomial(R, amplitudes[i], amplitudes[j]));
      return kept;
    }

    ReducedElasticity of_amplitudes(const ReducedElasticity &elasticity, const int R,
                                    const std::vector<int> &amplitudes)
    {
      if (elasticity.energy.are_given())
        return elasticity;
      const std::vector<int> kept = kept_strain_monomials(R, amplitudes);
      return {elasticity.gram_lambda(kept, kept), elasticity.gram_mu(kept, kept), elasticity.poisson_ratio, {}};
    }

    ReducedMagnet of_amplitudes(ReducedMagnet magnet, const std::vector<int> &amplitudes)
    {
      magnet.tail_area_of_mode_m = magnet.tail_area_of_mode_m(Eigen::all, amplitudes).eval();
      return magnet;
    }

    /// Bending alone changes the area to second order only, which other modes are there to undo: without them, it is
    /// let go.
    ReducedArea of_amplitudes(const ReducedArea &area, const std::vector<int> &amplitudes)
    {
      constexpr double round_off            = 1e-9;
      const bool       some_mode_changes_it = area.linear_m(amplitudes).norm() > round_off * area.linear_m.norm();
      return {area.is_kept && some_mode_changes_it, area.linear_m(amplitudes), area.quadratic(amplitudes, amplitudes)};
    }

    ReducedResistance leading_modes(const ReducedResistance &all, const int r, const int k)
    {
      const int              n    = k + 3;
      const std::vector<int> kept = features_without_modes_from(all.exponents, k, r);
      ReducedResistance      some = all;
      std::vector<int>       coordinates(static_cast<std::size_t>(k));
      for (int i = 0; i < k; ++i)
        coordinates[static_cast<std::size_t>(i)] = i;
      for (int i = 0; i < all.n_pose_coordinates(); ++i)
        coordinates.push_back(r + i);
      if (all.depends_on_height)
        some.usual_by_coordinate = all.usual_by_coordinate.head(k);
      some.factor_at_rest     = all.factor_at_rest.topLeftCorner(n, n);
      some.coordinate_scale_m = all.coordinate_scale_m.head(k);
      some.exponents          = all.exponents(kept, coordinates);
      some.coefficients       = all.coefficients(kept, Eigen::seqN(0, n * (n + 1) / 2));
      for (Eigen::MatrixXd &half : some.half_fits)
        half = half(kept, Eigen::seqN(0, n * (n + 1) / 2)).eval();
      return some;
    }

    InertiaPolynomials leading_modes(const InertiaPolynomials &all, const int r, const int k,
                                     const std::vector<int> &features)
    {
      const int        n = r + 3, m = k + 3, n_pairs = n * (n + 1) / 2, m_pairs = m * (m + 1) / 2;
      std::vector<int> quadratic;
      for (int i = 0; i < m; ++i)
        for (int pair = 0; pair < m_pairs; ++pair)
          quadratic.push_back(i * n_pairs + pair);
      return {all.factor_at_rest.topLeftCorner(m, m), all.mass(features, Eigen::seqN(0, m_pairs)),
              all.quadratic(features, quadratic)};
    }

    ReducedInertia leading_modes(const ReducedInertia &all, const int r, const int k)
    {
      if (!all.is_given())
        return all;
      const std::vector<int> kept = features_without_modes_from(all.exponents, k, r);
      std::vector<int>       coordinates;
      for (int i = 0; i < all.exponents.cols(); ++i)
        if (i < k || i >= r)
          coordinates.push_back(i);
      return {all.exponents(kept, coordinates), leading_modes(all.fluid, r, k, kept),
              leading_modes(all.tail, r, k, kept), all.head_area_m2, all.head_second_moment_m4};
    }
  } // namespace

  double saturated(const double rho)
  {
    return rho <= 1. ? rho : 1. + saturation_width * std::tanh((rho - 1.) / saturation_width);
  }

  double saturated_slope(const double rho)
  {
    if (rho <= 1.)
      return 1.;
    const double t = std::tanh((rho - 1.) / saturation_width);
    return 1. - t * t;
  }

  double saturated_curvature(const double rho)
  {
    if (rho <= 1.)
      return 0.;
    const double t = std::tanh((rho - 1.) / saturation_width);
    return -2. * t * (1. - t * t) / saturation_width;
  }

  ReducedModel truncated(const ReducedModel &model, const int n_modes)
  {
    const int r = model.n_modes();
    if (n_modes < 0 || n_modes > r)
      throw InputError(
          fmt::format("{} modes were asked of a reduced model that has {}; choose 1 to {}.", n_modes, r, r));
    ReducedModel few        = model;
    const auto   amplitudes = kept_amplitudes(model.tail, n_modes);
    few.tail                = leading_modes(model.tail, n_modes);
    few.elasticity          = of_amplitudes(model.elasticity, model.tail.n_amplitudes(), amplitudes);
    few.elasticity.energy   = of_leading_coordinates(model.elasticity.energy, n_modes);
    few.magnet              = of_amplitudes(model.magnet, amplitudes);
    few.area                = of_amplitudes(model.area, amplitudes);
    few.resistance          = leading_modes(model.resistance, r, n_modes);
    few.inertia             = leading_modes(model.inertia, r, n_modes);
    return few;
  }
} // namespace swimtwin
