#include <rom/swimmer/elastic_energy.h>

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

    Eigen::VectorXi monomial_parity(const Eigen::VectorXi &parity)
    {
      const int       n = static_cast<int>(parity.size());
      Eigen::VectorXi result(strain_monomial(n, n, 0));
      result.head(n) = parity;
      for (int i = 0, k = n; i < n; ++i)
        for (int j = 0; j <= i; ++j)
          result[k++] = parity[i] * parity[j];
      return result;
    }
  } // namespace

  ElasticEnergy::ElasticEnergy(const ReducedElasticity &elasticity, const ReducedTail &tail) : amplitudes_(tail)
  {
    if (elasticity.energy.are_given())
    {
      given_.emplace(elasticity.energy, tail.coordinate_parity());
      given_gradient_.emplace(gradient_of(elasticity.energy), tail.coordinate_parity());
      return;
    }
    Eigen::MatrixXd gram = lame_lambda(1., elasticity.poisson_ratio) * elasticity.gram_lambda +
                           shear_modulus(1., elasticity.poisson_ratio) * elasticity.gram_mu;
    gram += gram.transpose().eval();
    const Eigen::VectorXi parity = monomial_parity(tail.parity);
    const auto            signs  = parity.cast<double>().asDiagonal();
    gram                         = (0.5 * (gram + signs * gram * signs)).eval(); // exactly zero across parities
    place_.resize(static_cast<std::size_t>(parity.size()));
    int place = 0;
    for (const int sign : {1, -1})
    {
      std::vector<int> monomials;
      for (int k = 0; k < parity.size(); ++k)
        if (parity[k] == sign)
        {
          monomials.push_back(k);
          place_[static_cast<std::size_t>(k)] = place++;
        }
      blocks_.push_back({place - static_cast<int>(monomials.size()), gram(monomials, monomials)});
    }

    double n_entries = 0.;
    for (const Block &block : blocks_)
      n_entries += static_cast<double>(block.gram.size());
    const double n_monomials = EnergyGradient::most_monomials(tail);
    if (n_monomials <= EnergyGradient::max_monomials && n_monomials * tail.n_coordinates() < n_entries)
      by_coordinates_.emplace(gram, tail);
  }

  template <typename Visitor>
  void ElasticEnergy::for_each_product(const int n, const Visitor &visit) const
  {
    const int *place = place_.data() + n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        visit(*place++, i, j);
  }

  ElasticEnergy::StrainVector ElasticEnergy::monomials(const AmplitudeVector &p) const
  {
    const int    n = static_cast<int>(p.size());
    StrainVector m(static_cast<Eigen::Index>(place_.size()));
    for (int i = 0; i < n; ++i)
      m[place_[static_cast<std::size_t>(i)]] = p[i];
    for_each_product(n, [&](const int k, const int i, const int j) { m[k] = p[i] * p[j]; });
    return m;
  }

  ElasticEnergy::StrainVector ElasticEnergy::stress(const StrainVector &monomials) const
  {
    StrainVector s(monomials.size());
    for (const auto &[first, gram] : blocks_)
      s.segment(first, gram.rows()).noalias() = gram * monomials.segment(first, gram.rows());
    return s;
  }

  AmplitudeVector ElasticEnergy::gradient(const AmplitudeVector &p, const StrainVector &stress) const
  {
    const int       n = static_cast<int>(p.size());
    AmplitudeVector g(n);
    for (int i = 0; i < n; ++i)
      g[i] = stress[place_[static_cast<std::size_t>(i)]];
    for_each_product(n, [&](const int k, const int i, const int j) {
      g[i] += stress[k] * p[j];
      g[j] += stress[k] * p[i];
    });
    return g;
  }

  double ElasticEnergy::value(const ShapeVector &q) const
  {
    if (given_)
      return given_->value(q)[0];
    const StrainVector m = monomials(amplitudes_.value(q));
    return 0.5 * m.dot(stress(m));
  }

  ShapeVector ElasticEnergy::gradient(const ShapeVector &q) const
  {
    if (given_gradient_)
      return given_gradient_->value(q);
    if (by_coordinates_)
      return by_coordinates_->value(q);
    const AmplitudeVector p = amplitudes_.value(q);
    return amplitudes_.pull_back(q, gradient(p, stress(monomials(p))));
  }

  EnergySlopes ElasticEnergy::differentiate(const ShapeVector &q) const
  {
    if (given_gradient_ || by_coordinates_)
    {
      const ValuesAndSlopes at =
          given_gradient_ ? given_gradient_->differentiate(q) : by_coordinates_->differentiate(q);
      return {at.values, at.slopes};
    }
    const AmplitudeVector p = amplitudes_.value(q);
    const AmplitudeMatrix J = amplitudes_.slopes(q);
    const int             n = static_cast<int>(p.size());
    const StrainVector    s = stress(monomials(p));
    Eigen::MatrixXd       slope(s.size(), J.cols());               // of the monomials by q
    Eigen::MatrixXd       curvature = Eigen::MatrixXd::Zero(n, n); // of the monomials by p, weighted by the stress
    for (int i = 0; i < n; ++i)
      slope.row(place_[static_cast<std::size_t>(i)]) = J.row(i);
    for_each_product(n, [&](const int k, const int i, const int j) {
      slope.row(k) = p[j] * J.row(i) + p[i] * J.row(j);
      curvature(i, j) += s[k];
      curvature(j, i) += s[k];
    });
    const AmplitudeVector by_amplitudes = gradient(p, s);
    ShapeMatrix           H             = amplitudes_.curvature(q, by_amplitudes);
    H += J.transpose() * curvature * J;
    for (const auto &[first, gram] : blocks_)
    {
      const auto part = slope.middleRows(first, gram.rows());
      H += part.transpose() * (gram * part);
    }
    return {J.transpose() * by_amplitudes, H};
  }
} // namespace swimtwin
