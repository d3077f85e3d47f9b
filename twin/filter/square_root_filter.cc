#include <twin/filter/square_root_filter.h>
#include <twin/filter/triangular_root.h>

// Letters: S root of the state's covariance, H slopes, R noise. The rows
//
//   sigma I   0           and their triangle      E^T  K^T
//   (H S)^T   S^T                                 0    S+^T
//
// have E E^T = H S S^T H^T + R, K = S S^T H^T E^-T and S+ the root after the update.

namespace swimtwin
{
  SquareRootFilter::SquareRootFilter(const Eigen::Index n_states, const Eigen::Index n_noises)
      : prediction_(n_states + n_noises, n_states), update_(max_rows + n_states, max_rows + n_states),
        product_(n_states, max_rows), workspace_(max_rows + n_states)
  {
  }

  void SquareRootFilter::predict(const Eigen::MatrixXd &transition, const Eigen::MatrixXd &noise, Eigen::MatrixXd &root)
  {
    const Eigen::Index n                 = root.rows();
    prediction_.topRows(n).noalias()     = root.transpose().triangularView<Eigen::Upper>() * transition.transpose();
    prediction_.bottomRows(noise.cols()) = noise.transpose();
    triangularise(prediction_, workspace_);
    root = prediction_.topRows(n).transpose();
  }

  double SquareRootFilter::distance_squared(const Eigen::Ref<const Eigen::VectorXd> &residual,
                                            const Eigen::Ref<const Eigen::MatrixXd> &slopes, const double sigma,
                                            const Belief &belief, Eigen::Vector2d &standard_deviation)
  {
    const Eigen::Index m                     = residual.size();
    auto               product               = product_.leftCols(m);
    product.noalias()                        = belief.root.transpose() * slopes.transpose();
    Eigen::Matrix2d covariance               = Eigen::Matrix2d::Identity();
    covariance.topLeftCorner(m, m).noalias() = product.transpose() * product;
    covariance.diagonal().head(m).array() += sigma * sigma;
    standard_deviation.setZero();
    standard_deviation.head(m) = covariance.diagonal().head(m).cwiseSqrt();
    Eigen::Vector2d r          = Eigen::Vector2d::Zero();
    r.head(m)                  = residual;
    return r.dot(covariance.inverse() * r);
  }

  void SquareRootFilter::update(const Eigen::Ref<const Eigen::VectorXd> &residual,
                                const Eigen::Ref<const Eigen::MatrixXd> &slopes, const double sigma, Belief &belief,
                                UpdateRecord &record)
  {
    const Eigen::Index m = residual.size(), n = belief.size();
    auto               rows  = update_.topLeftCorner(m + n, m + n);
    rows.topLeftCorner(m, m) = sigma * Eigen::Matrix2d::Identity().topLeftCorner(m, m);
    rows.topRightCorner(m, n).setZero();
    rows.bottomLeftCorner(n, m).noalias() = belief.root.transpose() * slopes.transpose();
    rows.bottomRightCorner(n, n)          = belief.root.transpose();
    triangularise(rows, workspace_);
    record.slopes   = slopes;
    record.root     = rows.topLeftCorner(m, m).transpose();
    record.gain     = rows.topRightCorner(m, n).transpose();
    record.whitened = residual;
    record.root.triangularView<Eigen::Lower>().solveInPlace(record.whitened);
    belief.mean.noalias() += record.gain * record.whitened;
    belief.root = rows.bottomRightCorner(n, n).transpose();
  }
} // namespace swimtwin
