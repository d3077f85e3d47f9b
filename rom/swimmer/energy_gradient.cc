#include <rom/swimmer/energy_gradient.h>

#include <algorithm>
#include <map>

namespace swimtwin
{
  namespace
  {
    using Exponents  = std::vector<int>; // of the coordinates
    using Polynomial = std::map<Exponents, double>;

    Exponents sum(Exponents a, const Exponents &b)
    {
      for (std::size_t k = 0; k < a.size(); ++k)
        a[k] += b[k];
      return a;
    }

    Polynomial product(const Polynomial &a, const Polynomial &b)
    {
      Polynomial result;
      for (const auto &[e, x] : a)
        for (const auto &[f, y] : b)
          result[sum(e, f)] += x * y;
      return result;
    }

    /// Of the coordinates, then of the followers.
    std::vector<Polynomial> amplitudes(const ReducedTail &tail)
    {
      const int               r = tail.n_coordinates();
      std::vector<Polynomial> result;
      std::vector<Exponents>  q;
      for (int i = 0; i < r; ++i)
      {
        q.emplace_back(static_cast<std::size_t>(r), 0);
        q.back()[static_cast<std::size_t>(i)] = 1;
        result.push_back({{q.back(), 1.}});
      }
      for (Eigen::Index f = 0; f < tail.followers.rows(); ++f)
      {
        Polynomial follower;
        int        k = 0;
        for (const Exponents &q_i : q)
          for (const Exponents &q_j : q)
          {
            follower[sum(q_i, q_j)] = tail.followers(f, k++);
            if (&q_j == &q_i)
              break;
          }
        result.push_back(std::move(follower));
      }
      return result;
    }

    /// Amplitudes, then their products.
    std::vector<Polynomial> strain_monomials(const ReducedTail &tail)
    {
      std::vector<Polynomial> result = amplitudes(tail);
      for (std::size_t i = 0, n = result.size(); i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          result.push_back(product(result[i], result[j]));
      return result;
    }

    /// m^T gram m / 2, through the monomials of the coordinates that the strain monomials m share.
    Polynomial energy(const Eigen::MatrixXd &gram, const ReducedTail &tail)
    {
      const std::vector<Polynomial>     strain = strain_monomials(tail);
      std::map<Exponents, Eigen::Index> places;
      for (const Polynomial &m : strain)
        for (const auto &[e, c] : m)
          places.emplace(e, static_cast<Eigen::Index>(places.size()));
      Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(gram.rows(), static_cast<Eigen::Index>(places.size()));
      for (std::size_t row = 0; row < strain.size(); ++row)
        for (const auto &[e, c] : strain[row])
          shares(static_cast<Eigen::Index>(row), places.at(e)) = c;
      const Eigen::MatrixXd shared = 0.5 * shares.transpose() * gram * shares;
      Polynomial            result;
      for (const auto &[e, a] : places)
        for (const auto &[f, b] : places)
          if (shared(a, b) != 0.)
            result[sum(e, f)] += shared(a, b);
      return result;
    }
  } // namespace

  EnergyGradient::Terms EnergyGradient::terms(const Eigen::MatrixXd &gram, const ReducedTail &tail)
  {
    const int              r          = tail.n_coordinates();
    const Polynomial       polynomial = energy(gram, tail);
    std::vector<Exponents> rows;
    Terms                  terms;
    for (int k = 0; k < r; ++k)
      for (const auto &[e, c] : polynomial)
        if (const int power = e[static_cast<std::size_t>(k)]; power > 0)
        {
          rows.push_back(e);
          --rows.back()[static_cast<std::size_t>(k)];
          terms.coordinate.push_back(k);
          terms.coefficient.push_back(power * c);
        }
    terms.exponents.resize(static_cast<Eigen::Index>(rows.size()), r);
    for (std::size_t i = 0; i < rows.size(); ++i)
      terms.exponents.row(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::RowVectorXi>(rows[i].data(), r);
    return terms;
  }

  double EnergyGradient::most_monomials(const ReducedTail &tail)
  {
    const int r = tail.n_coordinates(), degree = tail.followers.rows() > 0 ? 7 : 3;
    double    n = 1.;
    for (int k = 1; k <= degree; ++k)
      n *= static_cast<double>(r + k) / k;
    return n;
  }

  EnergyGradient::EnergyGradient(const Eigen::MatrixXd &gram, const ReducedTail &tail)
      : EnergyGradient(terms(gram, tail), tail)
  {
  }

  EnergyGradient::EnergyGradient(const Terms &terms, const ReducedTail &tail)
      : monomials_(terms.exponents, tail.coordinate_parity()),
        coefficients_(Eigen::MatrixXd::Zero(monomials_.size(), tail.n_coordinates()))
  {
    first_ = monomials_.size();
    for (std::size_t row = 0; row < terms.coordinate.size(); ++row)
    {
      const int position = monomials_.position_of_row(static_cast<int>(row));
      coefficients_(position, terms.coordinate[row]) += terms.coefficient[row];
      first_ = std::min<Eigen::Index>(first_, position);
    }
    coefficients_ = coefficients_.bottomRows(monomials_.size() - first_).eval();
  }

  ShapeVector EnergyGradient::value(const ShapeVector &q) const
  {
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_monomials, 1> m(monomials_.size());
    monomials_.evaluate(q, m);
    ShapeVector gradient(q.size());
    gradient.noalias() = coefficients_.transpose() * m.tail(coefficients_.rows());
    return gradient;
  }

  ShapeMatrix EnergyGradient::slopes(const ShapeVector &q) const
  {
    Eigen::MatrixXd m(monomials_.size(), 1 + q.size());
    monomials_.evaluate_with_gradient(q, m);
    return coefficients_.transpose() * m.bottomRightCorner(coefficients_.rows(), q.size());
  }
} // namespace swimtwin
