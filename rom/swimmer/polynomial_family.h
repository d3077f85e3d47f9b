// Many polynomials of the same coordinates, with their derivatives, from one vector of monomials.
#pragma once

#include <rom/swimmer/monomial_table.h>

#include <vector>

namespace swimtwin
{
  /// The derivatives are polynomials of the same monomials, so that no monomial is ever differentiated. Those that
  /// share their parity, and with it their monomials, are one product of a matrix with a vector.
  class PolynomialFamily
  {
  public:
    /// `coefficients` as models hold them: one polynomial per column, one row per row of the table's exponents.
    PolynomialFamily(const MonomialTable &monomials, const Eigen::MatrixXd &coefficients);

    int n_results() const { return n_results_; }
    /// Where the value of a polynomial stands among the results, and its derivative by a coordinate.
    Eigen::Index value_place(const Eigen::Index polynomial) const { return places_(polynomial, 0); }
    Eigen::Index slope_place(const Eigen::Index polynomial, const Eigen::Index coordinate) const
    {
      return places_(polynomial, 1 + coordinate);
    }

    using Monomials = Eigen::Ref<const Eigen::VectorXd>;
    using Results   = Eigen::Ref<Eigen::VectorXd>; ///< n_results()
    void evaluate(const Monomials &monomials, Results results) const;
    /// Derivatives too.
    void differentiate(const Monomials &monomials, Results results) const;

  private:
    /// Results from `first_result` on: coefficients times the monomials from `first_monomial` on.
    struct Product
    {
      Eigen::Index    first_result = 0, first_monomial = 0;
      Eigen::MatrixXd coefficients;
    };

    void add_products(const MonomialTable &monomials, const Eigen::MatrixXd &coefficients, Eigen::Index first_column,
                      std::vector<Product> &products);

    std::vector<Product>                                        values_, slopes_;
    Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> places_; ///< value, then derivatives, as columns
    int                                                         n_results_ = 0;
  };
} // namespace swimtwin
