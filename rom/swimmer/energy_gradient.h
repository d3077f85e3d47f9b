// The elastic energy's gradient as polynomials of the coordinates alone.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/monomial_table.h>
#include <rom/swimmer/state_vectors.h>

#include <vector>

namespace swimtwin
{
  /// Where coordinates are few, the followers put in once and for all leave far fewer terms than the strain monomials
  /// have products. Per Young's modulus, like ElasticEnergy.
  class EnergyGradient
  {
  public:
    /// How many monomials the gradient can have; grows fast with the coordinates.
    static double        most_monomials(const ReducedTail &tail);
    static constexpr int max_monomials = 1024;

    /// `gram`: twice that of the energy, for the amplitudes, then their products (p_i p_j, j <= i), whose number of
    /// gradient monomials is within `max_monomials`.
    EnergyGradient(const Eigen::MatrixXd &gram, const ReducedTail &tail);

    ShapeVector value(const ShapeVector &q) const;
    /// The energy's Hessian.
    ShapeMatrix slopes(const ShapeVector &q) const;

  private:
    /// Monomials (one row of exponents each) of the energy's derivatives by the coordinates; rows may repeat.
    struct Terms
    {
      Eigen::MatrixXi     exponents;
      std::vector<int>    coordinate;
      std::vector<double> coefficient;
    };
    static Terms terms(const Eigen::MatrixXd &gram, const ReducedTail &tail);
    EnergyGradient(const Terms &terms, const ReducedTail &tail);

    MonomialTable   monomials_;
    Eigen::MatrixXd coefficients_; ///< of the monomials from `first_` on, one column for each coordinate
    Eigen::Index    first_ = 0;
  };
} // namespace swimtwin
