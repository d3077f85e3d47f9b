// Polynomials of the shape's coordinates, all of them at once.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/polynomial_family.h>
#include <rom/swimmer/state_vectors.h>

namespace swimtwin
{
  struct ValuesAndSlopes
  {
    AmplitudeVector values;
    AmplitudeMatrix slopes; ///< by the coordinates (not scaled)
  };

  class CoordinatePolynomials
  {
  public:
    /// At most max_amplitudes of them. `parity` of the coordinates.
    CoordinatePolynomials(const ShapePolynomials &polynomials, const Eigen::VectorXi &parity);

    int             size() const { return size_; }
    AmplitudeVector value(const ShapeVector &q) const;
    /// size() of them, and size() x r.
    ValuesAndSlopes differentiate(const ShapeVector &q) const;
    AmplitudeMatrix slopes(const ShapeVector &q) const { return differentiate(q).slopes; }

    static constexpr int max_monomials = 2048;

  private:
    using MonomialVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_monomials, 1>;
    using ResultVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_amplitudes *(1 + max_modes), 1>;

    MonomialVector monomials_at(const ShapeVector &q) const;

    int              size_ = 0;
    ShapeVector      inverse_scale_;
    MonomialTable    monomials_;
    PolynomialFamily family_;
  };

  /// The derivatives of all polynomials by a coordinate, as polynomials.
  ShapePolynomials derivative_of(const ShapePolynomials &polynomials, Eigen::Index coordinate);
  /// The derivatives of the first polynomial by all coordinates, as polynomials.
  ShapePolynomials gradient_of(const ShapePolynomials &polynomials);
} // namespace swimtwin
