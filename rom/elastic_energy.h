// The exact St Venant-Kirchhoff energy of the modes, a quartic polynomial.
#pragma once

#include <datasets/reduced_model.h>
#include <rom/state_vectors.h>

namespace swimtwin
{
  /// Per Young's modulus: multiply value (m^2), gradient (m) and Hessian (1) by E to get J/m, N/m and Pa.
  class ElasticEnergy
  {
  public:
    explicit ElasticEnergy(const ReducedElasticity &elasticity);

    double      value(const ShapeVector &q) const;
    ShapeVector gradient(const ShapeVector &q) const;
    ShapeMatrix hessian(const ShapeVector &q) const;

  private:
    static constexpr int max_monomials = max_modes + max_modes * (max_modes + 1) / 2;
    using StrainVector                 = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_monomials, 1>;

    static StrainVector monomials(const ShapeVector &q);
    /// 2 G m(q): the energy's derivative by the monomials.
    StrainVector stress(const ShapeVector &q) const;

    Eigen::MatrixXd gram_;
  };
} // namespace swimtwin
