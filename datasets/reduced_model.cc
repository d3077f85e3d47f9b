#include <datasets/error.h>
#include <datasets/reduced_model.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double saturation_width = 0.1;

    ReducedTail leading_modes(ReducedTail tail, const int k)
    {
      tail.modes  = tail.modes.leftCols(k).eval();
      tail.parity = tail.parity.head(k).eval();
      return tail;
    }

    /// Indices of the strain monomials of the first k of r modes among those of all r.
    Eigen::VectorXi kept_strain_monomials(const int r, const int k)
    {
      Eigen::VectorXi kept(strain_monomial(k, k, 0));
      for (int i = 0; i < k; ++i)
      {
        kept[i] = i;
        for (int j = 0; j <= i; ++j)
          kept[strain_monomial(k, i, j)] = strain_monomial(r, i, j);
      }
      return kept;
    }

    ReducedElasticity leading_modes(const ReducedElasticity &elasticity, const int r, const int k)
    {
      const Eigen::VectorXi kept = kept_strain_monomials(r, k);
      return {elasticity.gram_lambda(kept, kept), elasticity.gram_mu(kept, kept), elasticity.poisson_ratio};
    }

    ReducedMagnet leading_modes(ReducedMagnet magnet, const int k)
    {
      magnet.tail_area_of_mode_m = magnet.tail_area_of_mode_m.leftCols(k).eval();
      return magnet;
    }

    ReducedArea leading_modes(const ReducedArea &area, const int k)
    {
      return {area.is_kept, area.linear_m.head(k), area.quadratic.topLeftCorner(k, k)};
    }

    std::vector<int> features_without_modes_from(const Eigen::MatrixXi &exponents, const int k, const int r)
    {
      std::vector<int> kept;
      for (int f = 0; f < exponents.rows(); ++f)
        if ((exponents.row(f).segment(k, r - k).array() == 0).all())
          kept.push_back(f);
      return kept;
    }

    ReducedResistance leading_modes(const ReducedResistance &all, const int r, const int k)
    {
      const int              n    = k + 3;
      const std::vector<int> kept = features_without_modes_from(all.exponents, k, r);
      ReducedResistance      some = all;
      std::vector<int>       coordinates(static_cast<std::size_t>(k));
      for (int i = 0; i < k; ++i)
        coordinates[static_cast<std::size_t>(i)] = i;
      if (all.depends_on_angle)
        coordinates.push_back(r);
      some.factor_at_rest     = all.factor_at_rest.topLeftCorner(n, n);
      some.coordinate_scale_m = all.coordinate_scale_m.head(k);
      some.exponents          = all.exponents(kept, coordinates);
      some.coefficients       = all.coefficients(kept, Eigen::seqN(0, n * (n + 1) / 2));
      return some;
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

  ReducedModel truncated(const ReducedModel &model, const int n_modes)
  {
    const int r = model.n_modes();
    if (n_modes < 0 || n_modes > r)
      throw InputError(
          fmt::format("{} modes were asked of a reduced model that has {}; choose 1 to {}.", n_modes, r, r));
    ReducedModel few = model;
    few.tail         = leading_modes(model.tail, n_modes);
    few.elasticity   = leading_modes(model.elasticity, r, n_modes);
    few.magnet       = leading_modes(model.magnet, n_modes);
    few.area         = leading_modes(model.area, n_modes);
    few.resistance   = leading_modes(model.resistance, r, n_modes);
    return few;
  }
} // namespace swimtwin
