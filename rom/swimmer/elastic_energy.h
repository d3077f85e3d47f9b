// The elastic energy: exact for modes of a St Venant-Kirchhoff tail, a quartic polynomial of their amplitudes, or one
// that is given as a polynomial of the coordinates.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/energy_gradient.h>
#include <rom/swimmer/shape_amplitudes.h>

#include <optional>
#include <vector>

namespace swimtwin
{
  struct EnergySlopes
  {
    ShapeVector gradient;
    ShapeMatrix hessian;
  };

  /// Per Young's modulus: multiply value (m^2), gradient (m) and Hessian (1) by E to get J/m, N/m and Pa.
  class ElasticEnergy
  {
  public:
    ElasticEnergy(const ReducedElasticity &elasticity, const ReducedTail &tail);

    double      value(const ShapeVector &q) const;
    ShapeVector gradient(const ShapeVector &q) const;
    ShapeMatrix hessian(const ShapeVector &q) const { return differentiate(q).hessian; }
    /// Gradient and Hessian for little more than the latter.
    EnergySlopes differentiate(const ShapeVector &q) const;

  private:
    /// Strain monomials of one parity under the mirror, which stand together: strains of different parity do no work on
    /// each other.
    struct Block
    {
      int             first = 0;
      Eigen::MatrixXd gram; ///< twice that of the energy
    };
    static constexpr int max_monomials = max_amplitudes + max_amplitudes * (max_amplitudes + 1) / 2;
    using StrainVector                 = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_monomials, 1>;

    /// visit(place, i, j) for the product p_i p_j of each pair of n amplitudes.
    template <typename Visitor>
    void         for_each_product(int n, const Visitor &visit) const;
    StrainVector monomials(const AmplitudeVector &p) const;
    /// The energy's derivative by the monomials.
    StrainVector stress(const StrainVector &monomials) const;
    /// By the amplitudes, from that by the monomials.
    AmplitudeVector gradient(const AmplitudeVector &p, const StrainVector &stress) const;

    /// An energy that is given as a polynomial, and its gradient.
    std::optional<CoordinatePolynomials> given_, given_gradient_;
    ShapeAmplitudes                      amplitudes_;
    std::optional<EnergyGradient>        by_coordinates_; ///< where it is the shorter way
    std::vector<Block>                   blocks_;
    std::vector<int>                     place_; ///< of the amplitudes, then of their products, among the monomials
  };
} // namespace swimtwin
