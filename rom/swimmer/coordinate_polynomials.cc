#include <rom/swimmer/coordinate_polynomials.h>

#include <datasets/system/error.h>

#include <vector>

namespace swimtwin
{
  namespace
  {
    Eigen::MatrixXd ordered_as(const MonomialTable &table, const Eigen::MatrixXd &coefficients)
    {
      Eigen::MatrixXd ordered = Eigen::MatrixXd::Zero(coefficients.cols(), table.size());
      for (Eigen::Index row = 0; row < coefficients.rows(); ++row)
        ordered.col(table.position_of_row(static_cast<int>(row))) += coefficients.row(row).transpose();
      return ordered;
    }
  } // namespace

  CoordinatePolynomials::CoordinatePolynomials(const ShapePolynomials &polynomials, const Eigen::VectorXi &parity)
      : inverse_scale_(polynomials.scale_m.cwiseInverse()), monomials_(polynomials.exponents, parity),
        coefficients_(ordered_as(monomials_, polynomials.coefficients))
  {
    if (monomials_.size() > max_monomials)
      throw InputError("the reduced model has more monomials of its shape than this program computes with: train it "
                       "with fewer --modes.");
  }

  Eigen::VectorXd CoordinatePolynomials::value(const ShapeVector &q) const
  {
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_monomials, 1> m(monomials_.size());
    const ShapeVector                                                           z = q.cwiseProduct(inverse_scale_);
    monomials_.evaluate(z, m);
    return coefficients_ * m;
  }

  Eigen::MatrixXd CoordinatePolynomials::slopes(const ShapeVector &q) const
  {
    Eigen::MatrixXd   m(monomials_.size(), 1 + q.size());
    const ShapeVector z = q.cwiseProduct(inverse_scale_);
    monomials_.evaluate_with_gradient(z, m);
    return coefficients_ * m.rightCols(q.size()) * inverse_scale_.asDiagonal();
  }

  ShapePolynomials gradient_of(const ShapePolynomials &polynomials)
  {
    const Eigen::Index           r = polynomials.exponents.cols();
    std::vector<Eigen::VectorXi> exponents;
    std::vector<Eigen::VectorXd> coefficients;
    for (Eigen::Index row = 0; row < polynomials.exponents.rows(); ++row)
      for (Eigen::Index k = 0; k < r; ++k)
        if (const int power = polynomials.exponents(row, k); power > 0)
        {
          exponents.emplace_back(polynomials.exponents.row(row).transpose());
          --exponents.back()(k);
          coefficients.emplace_back(Eigen::VectorXd::Zero(r));
          coefficients.back()(k) = power * polynomials.coefficients(row, 0) / polynomials.scale_m(k);
        }
    ShapePolynomials gradient{polynomials.scale_m, Eigen::MatrixXi(exponents.size(), r),
                              Eigen::MatrixXd(coefficients.size(), r)};
    for (std::size_t row = 0; row < exponents.size(); ++row)
    {
      gradient.exponents.row(static_cast<Eigen::Index>(row))    = exponents[row].transpose();
      gradient.coefficients.row(static_cast<Eigen::Index>(row)) = coefficients[row].transpose();
    }
    return gradient;
  }
} // namespace swimtwin
