// The two steps of a Kalman filter on roots of covariances (G. J. Bierman, Factorization Methods for Discrete
// Sequential Estimation, 1977): no covariance is ever formed, so none can lose its positivity.
#pragma once

#include <twin/filter/belief.h>

namespace swimtwin
{
  /// An observation beside what was expected of it.
  struct Innovation
  {
    int             kind = 0, n_rows = 0;
    Eigen::Vector2d residual           = Eigen::Vector2d::Zero(); ///< observed minus expected
    Eigen::Vector2d standard_deviation = Eigen::Vector2d::Zero(); ///< expected of it
    double          distance_squared   = 0.;                      ///< chi-squared with n_rows degrees of freedom
    double          weight             = 1.;                      ///< that robustness leaves to it; 0: not used
  };

  /// What one update was made of: the signature of a fault passes through it too.
  struct UpdateRecord
  {
    Eigen::MatrixXd slopes; ///< m x n
    Eigen::MatrixXd root;   ///< m x m, lower triangular, of the innovation's covariance
    Eigen::MatrixXd gain;   ///< n x m: the mean moves by gain times the whitened innovation
    Eigen::VectorXd whitened;
  };

  /// Memory for states of one size; nothing is allocated afterwards.
  class SquareRootFilter
  {
  public:
    static constexpr Eigen::Index max_rows = 2;

    SquareRootFilter(Eigen::Index n_states, Eigen::Index n_noises);

    /// The root goes through a transition (n x n) and gets noise (n x n_noises).
    void predict(const Eigen::MatrixXd &transition, const Eigen::MatrixXd &noise, Eigen::MatrixXd &root);

    /// chi-squared of a residual (m), with its standard deviations.
    double distance_squared(const Eigen::Ref<const Eigen::VectorXd> &residual,
                            const Eigen::Ref<const Eigen::MatrixXd> &slopes, double sigma, const Belief &belief,
                            Eigen::Vector2d &standard_deviation);

    /// Take in a residual (m, at the belief's mean) of noise `sigma` in each row.
    void update(const Eigen::Ref<const Eigen::VectorXd> &residual, const Eigen::Ref<const Eigen::MatrixXd> &slopes,
                double sigma, Belief &belief, UpdateRecord &record);

  private:
    Eigen::MatrixXd prediction_, update_, product_;
    Eigen::VectorXd workspace_;
  };
} // namespace swimtwin
