// Amplitudes of all modes from the coordinates: followers are quadratic in them.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/state_vectors.h>

namespace swimtwin
{
  /// p(q) = (q, F products(q)) of ReducedTail, and its derivatives.
  class ShapeAmplitudes
  {
  public:
    explicit ShapeAmplitudes(const ReducedTail &tail);

    int n_coordinates() const { return r_; }
    int size() const { return r_ + static_cast<int>(followers_.rows()); }

    AmplitudeVector value(const ShapeVector &q) const;
    /// dp/dq, size() x r.
    AmplitudeMatrix slopes(const ShapeVector &q) const;
    /// slopes^T by_amplitudes, without the matrix.
    ShapeVector pull_back(const ShapeVector &q, const AmplitudeVector &by_amplitudes) const;
    /// sum_k weights_k d^2 p_k / dq^2; it does not depend on q.
    ShapeMatrix curvature(const AmplitudeVector &weights) const;

  private:
    int             r_;
    Eigen::MatrixXd followers_;
  };
} // namespace swimtwin
