// Polynomials of the shape's coordinates, all of them at once.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/monomial_table.h>
#include <rom/swimmer/state_vectors.h>

namespace swimtwin
{
  class CoordinatePolynomials
  {
  public:
    /// At most max_amplitudes of them. `parity` of the coordinates.
    CoordinatePolynomials(const ShapePolynomials &polynomials, const Eigen::VectorXi &parity);

    int             size() const { return static_cast<int>(coefficients_.rows()); }
    AmplitudeVector value(const ShapeVector &q) const;
    /// By the coordinates (not scaled), size() x r.
    AmplitudeMatrix slopes(const ShapeVector &q) const;

    static constexpr int max_monomials = 2048;

  private:
    ShapeVector     inverse_scale_;
    MonomialTable   monomials_;
    Eigen::MatrixXd coefficients_; ///< size() x monomials as the table orders them, from `first_` on
    Eigen::Index    first_ = 0;    ///< those before have no coefficients: of even ones, if all polynomials are odd
  };

  /// The derivatives of all polynomials by a coordinate, as polynomials.
  ShapePolynomials derivative_of(const ShapePolynomials &polynomials, Eigen::Index coordinate);
  /// The derivatives of the first polynomial by all coordinates, as polynomials.
  ShapePolynomials gradient_of(const ShapePolynomials &polynomials);
} // namespace swimtwin
