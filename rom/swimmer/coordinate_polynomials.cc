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

    Eigen::Index first_nonzero_column(const Eigen::MatrixXd &matrix)
    {
      Eigen::Index first = 0;
      while (first < matrix.cols() && matrix.col(first).isZero(0.))
        ++first;
      return first;
    }
  } // namespace

  CoordinatePolynomials::CoordinatePolynomials(const ShapePolynomials &polynomials, const Eigen::VectorXi &parity)
      : inverse_scale_(polynomials.scale_m.cwiseInverse()), monomials_(polynomials.exponents, parity),
        coefficients_(ordered_as(monomials_, polynomials.coefficients))
  {
    if (monomials_.size() > max_monomials)
      throw InputError("the reduced model has more monomials of its shape than this program computes with: train it "
                       "with fewer --modes.");
    first_        = first_nonzero_column(coefficients_);
    coefficients_ = coefficients_.rightCols(coefficients_.cols() - first_).eval();
  }

  AmplitudeVector CoordinatePolynomials::value(const ShapeVector &q) const
  {
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_monomials, 1> m(monomials_.size());
    const ShapeVector                                                           z = q.cwiseProduct(inverse_scale_);
    monomials_.evaluate(z, m);
    AmplitudeVector values(size());
    values.noalias() = coefficients_ * m.tail(coefficients_.cols());
    return values;
  }

  AmplitudeMatrix CoordinatePolynomials::slopes(const ShapeVector &q) const
  {
    Eigen::MatrixXd   m(monomials_.size(), 1 + q.size());
    const ShapeVector z = q.cwiseProduct(inverse_scale_);
    monomials_.evaluate_with_gradient(z, m);
    AmplitudeMatrix slopes(size(), q.size());
    slopes.noalias() = coefficients_ * m.bottomRightCorner(coefficients_.cols(), q.size());
    return slopes * inverse_scale_.asDiagonal();
  }

  ShapePolynomials derivative_of(const ShapePolynomials &polynomials, const Eigen::Index coordinate)
  {
    std::vector<int> rows;
    for (Eigen::Index row = 0; row < polynomials.exponents.rows(); ++row)
      if (polynomials.exponents(row, coordinate) > 0)
        rows.push_back(static_cast<int>(row));
    ShapePolynomials      derivative{polynomials.scale_m, polynomials.exponents(rows, Eigen::all),
                                polynomials.coefficients(rows, Eigen::all)};
    const Eigen::VectorXd power = derivative.exponents.col(coordinate).cast<double>();
    derivative.coefficients     = (power / polynomials.scale_m(coordinate)).asDiagonal() * derivative.coefficients;
    derivative.exponents.col(coordinate).array() -= 1;
    return derivative;
  }

  ShapePolynomials gradient_of(const ShapePolynomials &polynomials)
  {
    const Eigen::Index r = polynomials.exponents.cols();
    ShapePolynomials   gradient{polynomials.scale_m, Eigen::MatrixXi(0, r), Eigen::MatrixXd(0, r)};
    for (Eigen::Index k = 0; k < r; ++k)
    {
      const ShapePolynomials by_k  = derivative_of(polynomials, k);
      const Eigen::Index     first = gradient.exponents.rows(), n = by_k.exponents.rows();
      gradient.exponents.conservativeResize(first + n, r);
      gradient.exponents.bottomRows(n) = by_k.exponents;
      gradient.coefficients.conservativeResize(first + n, r);
      gradient.coefficients.bottomRows(n).setZero();
      gradient.coefficients.bottomRows(n).col(k) = by_k.coefficients.col(0);
    }
    return gradient;
  }
} // namespace swimtwin
