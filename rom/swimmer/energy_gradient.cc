#include <rom/swimmer/energy_gradient.h>

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

  ShapePolynomials EnergyGradient::polynomials(const Eigen::MatrixXd &gram, const ReducedTail &tail)
  {
    const int        r          = tail.n_coordinates();
    const Polynomial polynomial = energy(gram, tail);
    ShapePolynomials sum{Eigen::VectorXd::Ones(r), Eigen::MatrixXi(polynomial.size(), r),
                         Eigen::MatrixXd(polynomial.size(), 1)};
    Eigen::Index     row = 0;
    for (const auto &[e, c] : polynomial)
    {
      sum.exponents.row(row)     = Eigen::Map<const Eigen::RowVectorXi>(e.data(), r);
      sum.coefficients(row++, 0) = c;
    }
    return gradient_of(sum);
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
      : CoordinatePolynomials(polynomials(gram, tail), tail.coordinate_parity())
  {
  }
} // namespace swimtwin
