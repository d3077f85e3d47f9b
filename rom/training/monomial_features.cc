#include <rom/training/monomial_features.h>

#include <datasets/system/error.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    constexpr int highest_degree = 10;

    /// All exponents with prod effect_i^exponent_i >= bound, by degree.
    Eigen::MatrixXi features_above(const Eigen::VectorXd &effects, const double bound)
    {
      const int                    n = static_cast<int>(effects.size());
      std::vector<Eigen::VectorXi> found{Eigen::VectorXi::Zero(n)};
      std::vector<double>          value{1.};
      std::vector<int>             last{0}; // variables are appended in order, so that every monomial is made once
      for (std::size_t k = 0; k < found.size(); ++k)
        for (int i = last[k]; i < n; ++i)
          if (value[k] * effects(i) >= bound && found[k].sum() < highest_degree)
          {
            found.push_back(found[k]);
            ++found.back()(i);
            value.push_back(value[k] * effects(i));
            last.push_back(i);
          }
      Eigen::MatrixXi exponents(found.size(), n);
      for (std::size_t k = 0; k < found.size(); ++k)
        exponents.row(k) = found[k];
      return exponents;
    }
  } // namespace

  Eigen::VectorXd monomials(const Eigen::MatrixXi &exponents, const Eigen::VectorXd &z)
  {
    Eigen::VectorXd values = Eigen::VectorXd::Ones(exponents.rows());
    for (Eigen::Index i = 0; i < z.size(); ++i)
    {
      std::array<double, highest_degree + 1> power{1.};
      for (int d = 1; d <= highest_degree; ++d)
        power[d] = power[d - 1] * z(i);
      for (Eigen::Index k = 0; k < exponents.rows(); ++k)
        values(k) *= power[exponents(k, i)];
    }
    return values;
  }

  std::vector<int> counted(const Eigen::Index n)
  {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  std::vector<Fold> five_folds(const Eigen::Index n_rows)
  {
    constexpr int     n = 5;
    std::vector<Fold> folds(n);
    for (int fold = 0; fold < n; ++fold)
      for (int k = 0; k < n_rows; ++k)
        (k > 0 && k % n == fold ? folds[fold].held : folds[fold].kept).push_back(k);
    return folds;
  }

  std::vector<int> of_parity(const Eigen::MatrixXi &exponents, const int odd)
  {
    std::vector<int> rows;
    for (Eigen::Index k = 0; k < exponents.rows(); ++k)
      if (exponents.row(k).sum() % 2 == odd)
        rows.push_back(static_cast<int>(k));
    return rows;
  }

  Eigen::MatrixXd design(const Eigen::MatrixXi &exponents, const Eigen::MatrixXd &z)
  {
    Eigen::MatrixXd A(z.rows(), exponents.rows());
    for (Eigen::Index k = 0; k < z.rows(); ++k)
      A.row(k) = monomials(exponents, z.row(k).transpose()).transpose();
    return A;
  }

  std::vector<Eigen::MatrixXi> feature_sets(const Eigen::VectorXd &effects, const Eigen::Index n_samples,
                                            const bool has_parity)
  {
    // Nothing is analytic enough for a power of more than this.
    const Eigen::VectorXd        bounded = effects.cwiseMin(.7);
    std::vector<Eigen::MatrixXi> sets;
    for (double bound = .3; bound > 1e-9; bound *= .7)
    {
      Eigen::MatrixXi set    = features_above(bounded, bound);
      const auto      n_even = static_cast<Eigen::Index>(of_parity(set, 0).size()), n_odd = set.rows() - n_even;
      if (3 * (has_parity ? std::max(n_even, n_odd) : set.rows()) > n_samples)
        break;
      if (n_odd == 0)
        continue;
      if (sets.empty() || 4 * set.rows() > 5 * sets.back().rows())
        sets.push_back(std::move(set));
    }
    if (sets.empty())
      throw ComputationError("there are too few resistance samples for a fit: raise --samples");
    return sets;
  }

  Eigen::MatrixXd with_ridge(const Eigen::MatrixXd &A, const Eigen::VectorXd &weight, const double ridge)
  {
    Eigen::MatrixXd rows(A.rows() + A.cols(), A.cols());
    rows << A, ridge * weight.norm() * Eigen::MatrixXd::Identity(A.cols(), A.cols());
    return rows;
  }
} // namespace swimtwin
