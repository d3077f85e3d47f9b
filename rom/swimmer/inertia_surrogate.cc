#include <rom/swimmer/inertia_surrogate.h>

#include <rom/swimmer/lower_triangular.h>
#include <rom/swimmer/wide_product.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// F_1 F_2^T + F_2 F_1^T.
    VelocityMatrix symmetric_product(const VelocityMatrix &F_1, const VelocityMatrix &F_2)
    {
      const VelocityMatrix half = F_1.lazyProduct(F_2.transpose());
      return half + half.transpose();
    }

    /// Whether no term has a monomial of the other parity.
    bool has_mirror(const ReducedInertia &inertia, const Eigen::VectorXi &parity, const Eigen::VectorXi &of_velocity)
    {
      const MonomialTable monomials(inertia.exponents, parity);
      const auto          keeps = [&](const auto &in_order, const int term) {
        return (term > 0 ? in_order.tail(monomials.size() - monomials.n_even()) : in_order.head(monomials.n_even()))
            .isZero(0.);
      };
      const Eigen::Index n = of_velocity.size(), n_pairs = n * (n + 1) / 2;
      for (const auto *material : {&inertia.fluid, &inertia.tail})
      {
        const Eigen::MatrixXd mass      = monomials.in_order(material->mass),
                              quadratic = monomials.in_order(material->quadratic);
        for (Eigen::Index i = 0, pair = 0; i < n; ++i)
          for (Eigen::Index j = 0; j <= i; ++j, ++pair)
          {
            const int sign = of_velocity[i] * of_velocity[j];
            if (!keeps(mass.col(pair), sign))
              return false;
            for (Eigen::Index force = 0; force < n; ++force)
              if (!keeps(quadratic.col(force * n_pairs + pair), of_velocity[force] * sign))
                return false;
          }
      }
      return true;
    }

    Eigen::VectorXi even_unless(const bool has_mirror, const Eigen::VectorXi &parity)
    {
      return has_mirror ? parity : Eigen::VectorXi(Eigen::VectorXi::Ones(parity.size()));
    }
  } // namespace

  InertiaSurrogate::InertiaSurrogate(const ReducedInertia &inertia, const InertialDensities &densities,
                                     const Eigen::VectorXi &parity, const Eigen::VectorXi &velocity_parity)
      : InertiaSurrogate(inertia, densities, parity, velocity_parity, has_mirror(inertia, parity, velocity_parity))
  {
  }

  InertiaSurrogate::InertiaSurrogate(const ReducedInertia &inertia, const InertialDensities &densities,
                                     const Eigen::VectorXi &parity, const Eigen::VectorXi &of_velocity,
                                     const bool has_mirror)
      : n_(static_cast<int>(of_velocity.size())), velocity_parity_(even_unless(has_mirror, of_velocity)),
        monomials_(inertia.exponents, even_unless(has_mirror, parity))
  {
    std::vector<Term> pairs, triples;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j <= i; ++j)
        pairs.push_back({i, j, -1});
    for (const Term &pair : pairs)
      pairs_[velocity_parity_[pair.i] * velocity_parity_[pair.j] > 0 ? 0 : 1].push_back(pair);
    for (int i = 0; i < n_; ++i)
      for (const Term &pair : pairs)
        triples.push_back({i, pair.i, pair.j});
    masses_                   = {mass_of(inertia.fluid, densities.fluid_kg_m3, pairs),
                                 mass_of(inertia.tail, densities.tail_kg_m3, pairs)};
    Eigen::MatrixXd quadratic = monomials_.in_order(densities.fluid_kg_m3 * inertia.fluid.quadratic +
                                                    densities.tail_kg_m3 * inertia.tail.quadratic);
    set_head(inertia, densities.head_kg_m3, quadratic);
    quadratic_ = order(quadratic, triples);
  }

  /// About its own centre: M = diag(m, m, I), and m omega x U in its frame.
  void InertiaSurrogate::set_head(const ReducedInertia &inertia, const double density, Eigen::MatrixXd &quadratic)
  {
    const double m = density * inertia.head_area_m2;
    head_          = VelocityMatrix::Zero(n_, n_);
    head_.diagonal().head<3>() << m, m, density * inertia.head_second_moment_m4;
    const auto column = [&](const int i, const int j, const int k) {
      return i * n_ * (n_ + 1) / 2 + j * (j + 1) / 2 + k;
    };
    quadratic(monomials_.place_of_one(), column(0, 2, 1)) -= m;
    quadratic(monomials_.place_of_one(), column(1, 2, 0)) += m;
  }

  InertiaSurrogate::Polynomials InertiaSurrogate::order(const Eigen::MatrixXd   &coefficients,
                                                        const std::vector<Term> &terms) const
  {
    const auto is_even = [&](const Term &t) {
      return velocity_parity_[t.i] * velocity_parity_[t.j] * (t.k < 0 ? 1 : velocity_parity_[t.k]) > 0;
    };
    std::vector<Eigen::Index> columns; // of the coefficients, even ones first
    Polynomials               result;
    Eigen::Index              n_even = 0;
    for (const bool even : {true, false})
      for (std::size_t c = 0; c < terms.size(); ++c)
        if (is_even(terms[c]) == even)
        {
          columns.push_back(static_cast<Eigen::Index>(c));
          result.terms.push_back(terms[c]);
          n_even += even;
        }
    const Eigen::MatrixXd by_term = coefficients(Eigen::all, columns).transpose();
    const Eigen::Index    n       = monomials_.n_even();
    result.even                   = by_term.topLeftCorner(n_even, n);
    result.odd                    = by_term.bottomRightCorner(by_term.rows() - n_even, by_term.cols() - n);
    return result;
  }

  InertiaSurrogate::Mass InertiaSurrogate::mass_of(const InertiaPolynomials &material, const double density,
                                                   const std::vector<Term> &pairs) const
  {
    const Eigen::MatrixXd coefficients = monomials_.in_order(material.mass);
    Mass                  result{density, material.factor_at_rest, order(coefficients, pairs), {}};
    const auto            n_terms = static_cast<Eigen::Index>(pairs.size());
    result.gradient.assign(static_cast<std::size_t>(monomials_.n_coordinates()),
                           Eigen::MatrixXd::Zero(n_terms, monomials_.size()));
    for (const auto &[monomial, coordinate, power, lower] : monomials_.derivatives())
      for (Eigen::Index t = 0; t < n_terms; ++t)
      {
        const Term &term = result.entries.terms[static_cast<std::size_t>(t)];
        result.gradient[static_cast<std::size_t>(coordinate)](t, lower) +=
            power * coefficients(monomial, term.i * (term.i + 1) / 2 + term.j);
      }
    return result;
  }

  void InertiaSurrogate::Polynomials::evaluate(const Eigen::Ref<const Eigen::MatrixXd> &monomials,
                                               Eigen::Ref<Eigen::MatrixXd>              values) const
  {
    for (Eigen::Index c = 0; c < monomials.cols(); ++c)
    {
      const double *const monomial = monomials.col(c).data();
      double *const       value    = values.col(c).data();
      set_product(even, monomial, value);
      set_product(odd, monomial + even.cols(), value + even.rows());
    }
  }

  InertiaValues InertiaSurrogate::make() const
  {
    const int     m = monomials_.n_coordinates();
    InertiaValues v;
    v.mass              = VelocityMatrix::Zero(n_, n_);
    v.force             = VelocityVector::Zero(n_);
    v.mass_slopes       = std::vector<VelocityMatrix>(static_cast<std::size_t>(m), VelocityMatrix::Zero(n_, n_));
    v.force_by_velocity = VelocityMatrix::Zero(n_, n_);
    v.force_by_variable = v.force_by_rate = Eigen::MatrixXd::Zero(n_, m);
    v.monomials                           = Eigen::MatrixXd::Zero(monomials_.size(), 1 + m);
    v.rates                               = Eigen::MatrixXd::Zero(monomials_.size(), 2);
    v.quadratic_entries = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(quadratic_.terms.size()), 1 + m);
    for (auto &material : v.materials)
    {
      material.entries  = Eigen::MatrixXd::Zero(n_ * (n_ + 1) / 2, 2 + m);
      material.relative = material.relative_rate = material.factor = material.factor_rate =
          VelocityMatrix::Zero(n_, n_);
    }
    return v;
  }

  VelocityMatrix InertiaSurrogate::mass(const Eigen::VectorXd &z) const
  {
    InertiaValues values = make();
    evaluate(z, Eigen::VectorXd::Zero(z.size()), VelocityVector::Zero(n_), values);
    return values.mass;
  }

  void InertiaSurrogate::set_masses(InertiaValues &v) const
  {
    v.mass = head_;
    for (std::size_t material = 0; material < masses_.size(); ++material)
    {
      const Mass &mass = masses_[material];
      if (mass.density == 0.)
        continue;
      auto              &at   = v.materials[material];
      const Eigen::Index last = at.entries.cols() - 1;
      mass.entries.evaluate(v.rates.leftCols(1), at.entries.leftCols(1));
      mass.entries.evaluate(v.rates.rightCols(1), at.entries.rightCols(1));
      for (std::size_t t = 0; t < mass.entries.terms.size(); ++t)
      {
        const Term  &term  = mass.entries.terms[t];
        const auto   row   = static_cast<Eigen::Index>(t);
        const double value = at.entries(row, 0), rate = at.entries(row, last);
        at.relative(term.i, term.j)      = term.i == term.j ? std::exp(value) : value;
        at.relative_rate(term.i, term.j) = term.i == term.j ? at.relative(term.i, term.i) * rate : rate;
      }
      set_lower_product(mass.factor_at_rest, at.relative, at.factor);
      add_lower_square(mass.density, at.factor, v.mass);
    }
    v.mass.triangularView<Eigen::StrictlyUpper>() = v.mass.transpose();
  }

  void InertiaSurrogate::set_force(const VelocityVector &velocity, InertiaValues &v) const
  {
    v.force.setZero();
    for (std::size_t material = 0; material < masses_.size(); ++material)
      if (const auto &[density, L0, entries, gradient] = masses_[material]; density > 0.) // 1/2 dM/dt xi
      {
        const auto          &C = v.materials[material].relative, &C_rate = v.materials[material].relative_rate;
        const VelocityVector at_rest = transposed_lower_times(L0, velocity);
        const VelocityVector half    = lower_times(C, transposed_lower_times(C_rate, at_rest)) +
                                    lower_times(C_rate, transposed_lower_times(C, at_rest));
        v.force += .5 * density * lower_times(L0, half);
      }
    constexpr int n_most = max_velocities * (max_velocities + 1) / 2;
    using PairVector     = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, n_most, 1>;
    std::array<PairVector, 2> products; // of velocities: even, odd
    for (std::size_t odd : {0, 1})
    {
      products[odd].resize(static_cast<Eigen::Index>(pairs_[odd].size()));
      for (std::size_t pair = 0; pair < pairs_[odd].size(); ++pair)
        products[odd][static_cast<Eigen::Index>(pair)] = velocity[pairs_[odd][pair].i] * velocity[pairs_[odd][pair].j];
    }
    Eigen::Index row = 0;
    for (const bool even : {true, false}) // entries; those of one force follow each other
      for (int i = 0; i < n_; ++i)
      {
        const PairVector &of_force = products[(velocity_parity_[i] > 0) == even ? 0 : 1];
        v.force[i] += v.quadratic_entries.col(0).segment(row, of_force.size()).dot(of_force);
        row += of_force.size();
      }
  }

  void InertiaSurrogate::evaluate(const Eigen::VectorXd &z, const Eigen::VectorXd &z_rate,
                                  const VelocityVector &velocity, InertiaValues &v) const
  {
    monomials_.evaluate_with_rate(z, z_rate, v.rates);
    set_masses(v);
    quadratic_.evaluate(v.rates.leftCols(1), v.quadratic_entries.leftCols(1));
    set_force(velocity, v);
  }

  void InertiaSurrogate::differentiate(const Eigen::VectorXd &z, const Eigen::VectorXd &z_rate,
                                       const VelocityVector &velocity, InertiaValues &v) const
  {
    evaluate(z, z_rate, velocity, v);
    monomials_.evaluate_with_gradient(z, v.monomials);
    v.force_by_velocity.setZero();
    for (std::size_t material = 0; material < masses_.size(); ++material)
      if (auto &at = v.materials[material]; masses_[material].density > 0.)
      {
        set_lower_product(masses_[material].factor_at_rest, at.relative_rate, at.factor_rate);
        v.force_by_velocity += .5 * masses_[material].density * symmetric_product(at.factor, at.factor_rate);
      }
    v.force_by_variable.setZero();
    differentiate_quadratic(velocity, v);
    for (auto &slope : v.mass_slopes)
      slope.setZero();
    for (std::size_t material = 0; material < masses_.size(); ++material)
      if (masses_[material].density > 0.)
        differentiate_mass(masses_[material], z_rate, velocity, v.materials[material], v);
    for (Eigen::Index c = 0; c < z.size(); ++c)
      v.force_by_rate.col(c) = .5 * (v.mass_slopes[static_cast<std::size_t>(c)] * velocity);
  }

  void InertiaSurrogate::differentiate_quadratic(const VelocityVector &velocity, InertiaValues &v) const
  {
    const Eigen::Index m = v.monomials.cols() - 1;
    quadratic_.evaluate(v.monomials.rightCols(m), v.quadratic_entries.rightCols(m));
    for (std::size_t t = 0; t < quadratic_.terms.size(); ++t)
    {
      const auto &[i, j, k] = quadratic_.terms[t];
      const auto   row      = static_cast<Eigen::Index>(t);
      const double value    = v.quadratic_entries(row, 0);
      v.force_by_velocity(i, j) += value * velocity[k];
      v.force_by_velocity(i, k) += value * velocity[j];
      v.force_by_variable.row(i) += velocity[j] * velocity[k] * v.quadratic_entries.row(row).tail(m);
    }
  }

  void InertiaSurrogate::differentiate_mass(const Mass &mass, const Eigen::VectorXd &z_rate,
                                            const VelocityVector &velocity, InertiaValues::Material &at,
                                            InertiaValues &v) const
  {
    const Eigen::Index m = z_rate.size(), last = at.entries.cols() - 1;
    mass.entries.evaluate(v.monomials.rightCols(m), at.entries.middleCols(1, m));
    Eigen::MatrixXd of_rate = z_rate[0] * mass.gradient.front();
    for (Eigen::Index d = 1; d < m; ++d)
      of_rate += z_rate[d] * mass.gradient[static_cast<std::size_t>(d)];
    const Eigen::MatrixXd rate_slopes = of_rate * v.monomials.rightCols(m);
    for (Eigen::Index c = 0; c < m; ++c)
    {
      VelocityMatrix C = VelocityMatrix::Zero(n_, n_), C_rate = C, F = C, F_rate = C; // derivatives by z_c
      for (std::size_t t = 0; t < mass.entries.terms.size(); ++t)
      {
        const Term  &term  = mass.entries.terms[t];
        const auto   row   = static_cast<Eigen::Index>(t);
        const double slope = at.entries(row, 1 + c), rate_slope = rate_slopes(row, c);
        C(term.i, term.j)      = slope;
        C_rate(term.i, term.j) = rate_slope;
        if (term.i == term.j)
        {
          const double value     = at.relative(term.i, term.i);
          C(term.i, term.i)      = value * slope;
          C_rate(term.i, term.i) = value * (rate_slope + slope * at.entries(row, last));
        }
      }
      set_lower_product(mass.factor_at_rest, C, F);
      set_lower_product(mass.factor_at_rest, C_rate, F_rate);
      v.mass_slopes[static_cast<std::size_t>(c)] += mass.density * symmetric_product(at.factor, F);
      const VelocityMatrix rate_slope = symmetric_product(at.factor, F_rate) + symmetric_product(at.factor_rate, F);
      v.force_by_variable.col(c) += .5 * mass.density * (rate_slope * velocity);
    }
  }
} // namespace swimtwin
