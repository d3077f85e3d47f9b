#include <twin/filter/smoother.h>
#include <twin/filter/triangular_root.h>

namespace swimtwin
{
  namespace
  {
    /// G = P Phi^T (P after the step)^-1, from roots.
    Eigen::MatrixXd smoother_gain(const Eigen::MatrixXd &root, const FilterNode &next)
    {
      const auto            lower    = next.predicted.root.triangularView<Eigen::Lower>();
      const Eigen::MatrixXd whitened = lower.solve(next.transition * root);
      return lower.transpose().solve(whitened * root.transpose()).transpose();
    }

    Belief smoothed(const Belief &filtered, const FilterNode &next, const Belief &next_smoothed)
    {
      const Eigen::Index    n = filtered.size(), m = next.noise.cols();
      const Eigen::MatrixXd G = smoother_gain(filtered.root, next);
      Eigen::MatrixXd       rows(2 * n + m, n);
      rows.topRows(n)       = (filtered.root - G * (next.transition * filtered.root)).transpose();
      rows.middleRows(n, m) = (G * next.noise).transpose();
      rows.bottomRows(n)    = (G * next_smoothed.root).transpose();
      Eigen::VectorXd workspace(n);
      triangularise(rows, workspace);
      return {filtered.mean + G * (next_smoothed.mean - next.predicted.mean), rows.topRows(n).transpose()};
    }
  } // namespace

  std::vector<Belief> smoothed_beliefs(const WindowFilter &filter, const int first)
  {
    std::vector<Belief> beliefs(static_cast<std::size_t>(filter.n_nodes() - first));
    beliefs.back() = filter.latest().filtered;
    for (int i = filter.n_nodes() - 2; i >= first; --i)
    {
      const auto place = static_cast<std::size_t>(i - first);
      beliefs[place]   = smoothed(filter.node(i).filtered, filter.node(i + 1), beliefs[place + 1]);
    }
    return beliefs;
  }
} // namespace swimtwin
