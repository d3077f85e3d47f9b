#include <rom/swimmer/coordinate_polynomials.h>

#include <datasets/system/error.h>

#include <vector>

namespace swimtwin
{
  CoordinatePolynomials::CoordinatePolynomials(const ShapePolynomials &polynomials, const Eigen::VectorXi &parity)
      : size_(static_cast<int>(polynomials.coefficients.cols())), inverse_scale_(polynomials.scale_m.cwiseInverse()),
        monomials_(polynomials.exponents, parity), family_(monomials_, polynomials.coefficients)
  {
    if (monomials_.size() > max_monomials)
      throw InputError("the reduced model has more monomials of its shape than this program computes with: train it "
                       "with fewer --modes.");
  }

  CoordinatePolynomials::MonomialVector CoordinatePolynomials::monomials_at(const ShapeVector &q) const
  {
    MonomialVector    m(monomials_.size());
    const ShapeVector z = q.cwiseProduct(inverse_scale_);
    monomials_.evaluate(z, m);
    return m;
  }

  AmplitudeVector CoordinatePolynomials::value(const ShapeVector &q) const
  {
    ResultVector results(family_.n_results());
    family_.evaluate(monomials_at(q), results);
    AmplitudeVector values(size_);
    for (int i = 0; i < size_; ++i)
      values[i] = results[family_.value_place(i)];
    return values;
  }

  ValuesAndSlopes CoordinatePolynomials::differentiate(const ShapeVector &q) const
  {
    ResultVector results(family_.n_results());
    family_.differentiate(monomials_at(q), results);
    ValuesAndSlopes at{AmplitudeVector(size_), AmplitudeMatrix(size_, q.size())};
    for (int i = 0; i < size_; ++i)
    {
      at.values[i] = results[family_.value_place(i)];
      for (Eigen::Index k = 0; k < q.size(); ++k)
        at.slopes(i, k) = results[family_.slope_place(i, k)] * inverse_scale_[k];
    }
    return at;
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
