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

    /// visit(k, i, j) for the quadratic monomials of n amplitudes, p_i p_j at index k.
    template <typename Visitor>
    void for_each_product(const int n, const Visitor &visit)
    {
      int k = n;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j)
          visit(k++, i, j);
    }

    Eigen::VectorXi monomial_parity(const Eigen::VectorXi &parity)
    {
      const int       n = static_cast<int>(parity.size());
      Eigen::VectorXi result(strain_monomial(n, n, 0));
      result.head(n) = parity;
      for_each_product(n, [&](const int k, const int i, const int j) { result[k] = parity[i] * parity[j]; });
      return result;
    }
  } // namespace

  ElasticEnergy::ElasticEnergy(const ReducedElasticity &elasticity, const ReducedTail &tail) : amplitudes_(tail)
  {
    Eigen::MatrixXd gram = lame_lambda(1., elasticity.poisson_ratio) * elasticity.gram_lambda +
                           shear_modulus(1., elasticity.poisson_ratio) * elasticity.gram_mu;
    gram += gram.transpose().eval();
    const Eigen::VectorXi parity = monomial_parity(tail.parity);
    for (const int sign : {1, -1})
    {
      Block block;
      for (int k = 0; k < parity.size(); ++k)
        if (parity[k] == sign)
          block.monomials.push_back(k);
      block.gram = gram(block.monomials, block.monomials);
      blocks_.push_back(std::move(block));
    }
  }

  ElasticEnergy::StrainVector ElasticEnergy::monomials(const AmplitudeVector &p)
  {
    const int    n = static_cast<int>(p.size());
    StrainVector m(strain_monomial(n, n, 0));
    m.head(n) = p;
    for_each_product(n, [&](const int k, const int i, const int j) { m[k] = p[i] * p[j]; });
    return m;
  }

  ElasticEnergy::StrainVector ElasticEnergy::stress(const StrainVector &monomials) const
  {
    StrainVector s(monomials.size());
    for (const Block &block : blocks_)
    {
      const auto   n = static_cast<Eigen::Index>(block.monomials.size());
      StrainVector m(n), part(n);
      for (Eigen::Index k = 0; k < n; ++k)
        m[k] = monomials[block.monomials[static_cast<std::size_t>(k)]];
      part.noalias() = block.gram * m;
      for (Eigen::Index k = 0; k < n; ++k)
        s[block.monomials[static_cast<std::size_t>(k)]] = part[k];
    }
    return s;
  }

  AmplitudeVector ElasticEnergy::gradient(const AmplitudeVector &p, const StrainVector &stress)
  {
    AmplitudeVector g = stress.head(p.size());
    for_each_product(static_cast<int>(p.size()), [&](const int k, const int i, const int j) {
      g[i] += stress[k] * p[j];
      g[j] += stress[k] * p[i];
    });
    return g;
  }

  double ElasticEnergy::value(const ShapeVector &q) const
  {
    const StrainVector m = monomials(amplitudes_.value(q));
    return 0.5 * m.dot(stress(m));
  }

  ShapeVector ElasticEnergy::gradient(const ShapeVector &q) const
  {
    const AmplitudeVector p = amplitudes_.value(q);
    return amplitudes_.slopes(q).transpose() * gradient(p, stress(monomials(p)));
  }

  ShapeMatrix ElasticEnergy::hessian(const ShapeVector &q) const
  {
    const AmplitudeVector p = amplitudes_.value(q);
    const AmplitudeMatrix J = amplitudes_.slopes(q);
    const int             n = static_cast<int>(p.size());
    const StrainVector    s = stress(monomials(p));
    Eigen::MatrixXd       slope(s.size(), J.cols());               // of the monomials by q
    Eigen::MatrixXd       curvature = Eigen::MatrixXd::Zero(n, n); // of the monomials by p, weighted by the stress
    slope.topRows(n)                = J;
    for_each_product(n, [&](const int k, const int i, const int j) {
      slope.row(k) = p[j] * J.row(i) + p[i] * J.row(j);
      curvature(i, j) += s[k];
      curvature(j, i) += s[k];
    });
    ShapeMatrix H = amplitudes_.curvature(gradient(p, s));
    H += J.transpose() * curvature * J;
    for (const Block &block : blocks_)
    {
      const Eigen::MatrixXd part = slope(block.monomials, Eigen::all);
      H += part.transpose() * (block.gram * part);
    }
    return H;
  }
} // namespace swimtwin
