// Amplitudes of all modes from the coordinates: followers are quadratic in them, or all are polynomials.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/coordinate_polynomials.h>
#include <rom/swimmer/state_vectors.h>

#include <optional>
#include <vector>

namespace swimtwin
{
  /// p(q) = (q, F products(q)) of ReducedTail, or its polynomials, and their derivatives.
  class ShapeAmplitudes
  {
  public:
    explicit ShapeAmplitudes(const ReducedTail &tail);

    int n_coordinates() const { return r_; }
    int size() const { return polynomials_ ? polynomials_->size() : r_ + static_cast<int>(followers_.rows()); }

    AmplitudeVector value(const ShapeVector &q) const;
    /// dp/dq, size() x r.
    AmplitudeMatrix slopes(const ShapeVector &q) const;
    /// slopes^T by_amplitudes, without the matrix.
    ShapeVector pull_back(const ShapeVector &q, const AmplitudeVector &by_amplitudes) const;
    /// sum_k weights_k d^2 p_k / dq^2.
    ShapeMatrix curvature(const ShapeVector &q, const AmplitudeVector &weights) const;

  private:
    int                                  r_;
    Eigen::MatrixXd                      followers_;
    std::optional<CoordinatePolynomials> polynomials_; ///< of those given
    std::vector<CoordinatePolynomials>   derivatives_; ///< by each coordinate
  };
} // namespace swimtwin
