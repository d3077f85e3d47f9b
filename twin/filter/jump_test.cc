#include <twin/filter/jump_test.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double not_in_use = std::numeric_limits<double>::infinity();
  }

  JumpTest::JumpTest(const std::vector<JumpHypothesis> &hypotheses, const double interval_s, const int n_instants)
      : n_hypotheses_(static_cast<int>(hypotheses.size())), n_slots_(n_instants), interval_s_(interval_s)
  {
    const Eigen::Index n = hypotheses.empty() ? 0 : hypotheses.front().direction.size(),
                       k = static_cast<Eigen::Index>(n_slots_) * n_hypotheses_;
    directions_.resize(n, n_hypotheses_);
    for (int i = 0; i < n_hypotheses_; ++i)
      directions_.col(i) = hypotheses[static_cast<std::size_t>(i)].direction;
    signatures_ = moved_ = Eigen::MatrixXd::Zero(n, k);
    seen_                = Eigen::MatrixXd::Zero(SquareRootFilter::max_rows, k);
    score_ = information_ = Eigen::VectorXd::Zero(k);
    start_s_.assign(static_cast<std::size_t>(n_slots_), not_in_use);
  }

  void JumpTest::restart()
  {
    start_s_.assign(start_s_.size(), not_in_use);
    signatures_.setZero();
    score_.setZero();
    information_.setZero();
  }

  void JumpTest::advance(const double time_s, const Eigen::MatrixXd &transition)
  {
    if (!is_used())
      return;
    moved_.noalias() = transition * signatures_;
    signatures_.swap(moved_);
    if (time_s < last_start_s_ + interval_s_)
      return;
    last_start_s_                                = time_s;
    const Eigen::Index first                     = column(next_slot_, 0);
    signatures_.middleCols(first, n_hypotheses_) = directions_;
    score_.segment(first, n_hypotheses_).setZero();
    information_.segment(first, n_hypotheses_).setZero();
    start_s_[static_cast<std::size_t>(next_slot_)] = time_s;
    next_slot_                                     = (next_slot_ + 1) % n_slots_;
  }

  void JumpTest::learn(const UpdateRecord &record)
  {
    if (!is_used())
      return;
    const Eigen::Index m    = record.whitened.size();
    auto               seen = seen_.topRows(m);
    seen.noalias()          = record.slopes * signatures_;
    record.root.triangularView<Eigen::Lower>().solveInPlace(seen);
    score_.noalias() += seen.transpose() * record.whitened;
    information_ += seen.colwise().squaredNorm().transpose();
    signatures_.noalias() -= record.gain * seen;
  }

  std::optional<JumpFinding> JumpTest::most_likely(const double earliest_s) const
  {
    std::optional<JumpFinding> best;
    Eigen::VectorXd            largest = Eigen::VectorXd::Zero(n_hypotheses_);
    for (int slot = 0; slot < n_slots_; ++slot)
      for (int h = 0; h < n_hypotheses_; ++h)
      {
        const Eigen::Index k       = column(slot, h);
        const double       start_s = start_s_[static_cast<std::size_t>(slot)];
        if (start_s == not_in_use || start_s < earliest_s || information_[k] <= 0.)
          continue;
        const double ratio = score_[k] * score_[k] / information_[k];
        largest[h]         = std::max(largest[h], ratio);
        if (!best || ratio > best->ratio)
          best = JumpFinding{h, start_s, score_[k] / information_[k], 1. / std::sqrt(information_[k]), ratio};
      }
    for (int h = 0; best && h < n_hypotheses_; ++h)
      if (h != best->hypothesis)
        best->runner_up = std::max(best->runner_up, largest[h]);
    return best;
  }
} // namespace swimtwin
