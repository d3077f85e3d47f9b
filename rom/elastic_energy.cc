#include <rom/elastic_energy.h>

namespace swimtwin
{
  namespace
  {
    double lame_lambda(const double young_modulus, const double poisson_ratio)
    {
      return young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }

    double shear_modulus(const double young_modulus, const double poisson_ratio)
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }

    /// visit(k, i, j) for the quadratic monomials, q_i q_j at index k.
    template <typename Visitor>
    void for_each_product(const int r, const Visitor &visit)
    {
      int k = r;
      for (int i = 0; i < r; ++i)
        for (int j = 0; j <= i; ++j)
          visit(k++, i, j);
    }
  } // namespace

  ElasticEnergy::ElasticEnergy(const ReducedElasticity &elasticity)
      : gram_(lame_lambda(1., elasticity.poisson_ratio) * elasticity.gram_lambda +
              shear_modulus(1., elasticity.poisson_ratio) * elasticity.gram_mu)
  {
    gram_ = (0.5 * (gram_ + gram_.transpose())).eval();
  }

  ElasticEnergy::StrainVector ElasticEnergy::monomials(const ShapeVector &q)
  {
    const int    r = static_cast<int>(q.size());
    StrainVector m(strain_monomial(r, r, 0));
    m.head(r) = q;
    for_each_product(r, [&](const int k, const int i, const int j) { m[k] = q[i] * q[j]; });
    return m;
  }

  ElasticEnergy::StrainVector ElasticEnergy::stress(const ShapeVector &q) const
  {
    const StrainVector m = monomials(q);
    StrainVector       s(m.size());
    s.noalias() = 2. * gram_ * m;
    return s;
  }

  double ElasticEnergy::value(const ShapeVector &q) const
  {
    return 0.5 * monomials(q).dot(stress(q));
  }

  ShapeVector ElasticEnergy::gradient(const ShapeVector &q) const
  {
    const StrainVector s        = stress(q);
    ShapeVector        gradient = s.head(q.size());
    for_each_product(static_cast<int>(q.size()), [&](const int k, const int i, const int j) {
      gradient[i] += s[k] * q[j];
      gradient[j] += s[k] * q[i];
    });
    return gradient;
  }

  ShapeMatrix ElasticEnergy::hessian(const ShapeVector &q) const
  {
    const int          r = static_cast<int>(q.size());
    const StrainVector s = stress(q);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_monomials, max_modes> slope(s.size(), r);
    ShapeMatrix curvature = ShapeMatrix::Zero(r, r); // that of the monomials
    slope.setZero();
    slope.topRows(r).setIdentity();
    for_each_product(r, [&](const int k, const int i, const int j) {
      slope(k, i) += q[j];
      slope(k, j) += q[i];
      curvature(i, j) += s[k];
      curvature(j, i) += s[k];
    });
    curvature += 2. * slope.transpose() * (gram_ * slope);
    return curvature;
  }
} // namespace swimtwin
