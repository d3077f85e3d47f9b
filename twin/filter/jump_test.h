// Has something changed at an instant, and what? The generalised likelihood-ratio test of A. S. Willsky and H. L. Jones
// (IEEE Transactions on Automatic Control 21, 1976, p. 108).
#pragma once

#include <twin/filter/square_root_filter.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// A change of the state that may come at once: so much, in this direction.
  struct JumpHypothesis
  {
    std::string     name;
    Eigen::VectorXd direction; ///< n
  };

  struct JumpFinding
  {
    int    hypothesis = 0;
    double since_s    = 0.;
    double size = 0., standard_deviation = 0.; ///< in multiples of the direction
    double ratio     = 0.;                     ///< twice the logarithm of the likelihoods' ratio
    double runner_up = 0.;                     ///< the same of the most likely other hypothesis
  };

  /// For each hypothesis and each of the last instants at which it may have happened: what it would have left in the
  /// innovations since, given that the filter went on as if nothing had happened, and how well that explains them.
  class JumpTest
  {
  public:
    JumpTest() = default;
    /// Instants are `interval_s` apart, the last `n_instants` of them.
    JumpTest(const std::vector<JumpHypothesis> &hypotheses, double interval_s, int n_instants);

    bool is_used() const { return n_hypotheses_ > 0; }
    /// The next instant: the state goes through a transition.
    void advance(double time_s, const Eigen::MatrixXd &transition);
    /// After an update.
    void learn(const UpdateRecord &record);

    /// The most likely change since an instant; none without observations since.
    std::optional<JumpFinding> most_likely(double earliest_s = -std::numeric_limits<double>::infinity()) const;
    /// Forget all instants: the change has been dealt with.
    void restart();

  private:
    Eigen::Index column(const int slot, const int hypothesis) const { return slot * n_hypotheses_ + hypothesis; }

    int                 n_hypotheses_ = 0, n_slots_ = 0, next_slot_ = 0;
    double              interval_s_ = 0., last_start_s_ = -1e300;
    Eigen::MatrixXd     directions_;          ///< n x n_hypotheses
    Eigen::MatrixXd     signatures_;          ///< n x columns: error of the mean left by a change of size one
    Eigen::MatrixXd     moved_, seen_;        ///< memory
    Eigen::VectorXd     score_, information_; ///< of columns
    std::vector<double> start_s_;             ///< of slots; +inf: not in use
  };
} // namespace swimtwin
