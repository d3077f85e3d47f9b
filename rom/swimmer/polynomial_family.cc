#include <rom/swimmer/polynomial_family.h>

#include <rom/swimmer/wide_product.h>

namespace swimtwin
{
  namespace
  {
    /// Polynomials are rows. The derivatives of all by the first coordinate, then those by the second, ...
    Eigen::MatrixXd derivatives(const MonomialTable &monomials, const Eigen::MatrixXd &coefficients)
    {
      const Eigen::Index n      = coefficients.rows();
      Eigen::MatrixXd    result = Eigen::MatrixXd::Zero(n * monomials.n_coordinates(), coefficients.cols());
      for (const auto &[monomial, coordinate, power, lower] : monomials.derivatives())
        result.block(coordinate * n, lower, n, 1) += power * coefficients.col(monomial);
      return result;
    }

    struct Range
    {
      Eigen::Index first = 0, end = 0;
    };

    Range nonzero_columns(const Eigen::MatrixXd &matrix)
    {
      Range columns{0, matrix.cols()};
      while (columns.first < columns.end && matrix.col(columns.first).isZero(0.))
        ++columns.first;
      while (columns.end > columns.first && matrix.col(columns.end - 1).isZero(0.))
        --columns.end;
      return columns;
    }
  } // namespace

  PolynomialFamily::PolynomialFamily(const MonomialTable &monomials, const Eigen::MatrixXd &coefficients)
      : places_(coefficients.cols(), 1 + monomials.n_coordinates())
  {
    const Eigen::MatrixXd values = monomials.in_order(coefficients).transpose();
    add_products(monomials, values, 0, values_);
    add_products(monomials, derivatives(monomials, values), 1, slopes_);
  }

  /// One product for the even polynomials, one for the odd ones, and one for those that are neither.
  void PolynomialFamily::add_products(const MonomialTable &monomials, const Eigen::MatrixXd &coefficients,
                                      const Eigen::Index first_column, std::vector<Product> &products)
  {
    const Eigen::Index        n_even = monomials.n_even(), n_odd = monomials.size() - n_even;
    std::vector<Eigen::Index> even, odd, neither;
    for (Eigen::Index row = 0; row < coefficients.rows(); ++row)
    {
      const bool has_even = !coefficients.row(row).head(n_even).isZero(0.),
                 has_odd  = !coefficients.row(row).tail(n_odd).isZero(0.);
      (has_even && has_odd ? neither : has_odd ? odd : even).push_back(row);
    }
    for (const auto &rows : {even, odd, neither})
    {
      if (rows.empty())
        continue;
      const Eigen::MatrixXd part    = coefficients(rows, Eigen::all);
      const Range           columns = nonzero_columns(part);
      products.push_back({n_results_, columns.first, part.middleCols(columns.first, columns.end - columns.first)});
      for (const Eigen::Index row : rows)
        places_(row % places_.rows(), first_column + row / places_.rows()) = n_results_++;
    }
  }

  void PolynomialFamily::evaluate(const Monomials &monomials, Results results) const
  {
    for (const auto &[result, monomial, coefficients] : values_)
      set_product(coefficients, monomials.data() + monomial, results.data() + result);
  }

  void PolynomialFamily::differentiate(const Monomials &monomials, Results results) const
  {
    evaluate(monomials, results);
    for (const auto &[result, monomial, coefficients] : slopes_)
      set_product(coefficients, monomials.data() + monomial, results.data() + result);
  }
} // namespace swimtwin
