// The elastic energy's gradient as polynomials of the coordinates alone.
#pragma once

#include <rom/swimmer/coordinate_polynomials.h>

namespace swimtwin
{
  /// Where coordinates are few, the followers put in once and for all leave far fewer terms than the strain monomials
  /// have products. Per Young's modulus, like ElasticEnergy; its slopes are the energy's Hessian.
  class EnergyGradient : public CoordinatePolynomials
  {
  public:
    /// How many monomials the gradient can have; grows fast with the coordinates.
    static double        most_monomials(const ReducedTail &tail);
    static constexpr int max_monomials = 1024;

    /// `gram`: twice that of the energy, for the amplitudes, then their products (p_i p_j, j <= i), whose number of
    /// gradient monomials is within `max_monomials`.
    EnergyGradient(const Eigen::MatrixXd &gram, const ReducedTail &tail);

  private:
    static ShapePolynomials polynomials(const Eigen::MatrixXd &gram, const ReducedTail &tail);
  };
} // namespace swimtwin
