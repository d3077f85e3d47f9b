#include <calibration/misfit/node_grid.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    using Index = std::vector<int>; // of a node, per group

    /// Of nodes, both ends included.
    struct IndexBox
    {
      Index first, last;

      double n_nodes_in_layer_of(const std::size_t group) const
      {
        double n = 1.;
        for (std::size_t g = 0; g < first.size(); ++g)
          n *= g == group ? 1. : last[g] - first[g] + 1;
        return n;
      }
    };

    struct Layer
    {
      std::size_t group;
      int         node;
      double      share_of_failed;
    };

    /// Of the outer layers of `kept` that do not hold a node of `core`, the one with most failures.
    Layer worst_outer_layer(const IndexBox &kept, const IndexBox &core, const std::vector<Index> &failed)
    {
      Layer worst{0, 0, 0.};
      for (std::size_t g = 0; g < kept.first.size(); ++g)
        for (const int node : {kept.first[g], kept.last[g]})
          if (node < core.first[g] || node > core.last[g])
          {
            const auto   n = std::count_if(failed.begin(), failed.end(), [&](const Index &k) { return k[g] == node; });
            const double share = static_cast<double>(n) / kept.n_nodes_in_layer_of(g);
            if (share > worst.share_of_failed)
              worst = {g, node, share};
          }
      return worst;
    }
  } // namespace

  double chebyshev_node(const int k, const int n)
  {
    return n == 1 ? 0. : -std::cos(std::numbers::pi * k / (n - 1));
  }

  std::size_t NodeGrid::size() const
  {
    return std::accumulate(n_nodes_.begin(), n_nodes_.end(), std::size_t(1), std::multiplies<>());
  }

  std::vector<int> NodeGrid::index(std::size_t i) const
  {
    std::vector<int> k;
    for (const int n : n_nodes_)
    {
      k.push_back(static_cast<int>(i % static_cast<std::size_t>(n)));
      i /= static_cast<std::size_t>(n);
    }
    return k;
  }

  double NodeGrid::coordinate(const std::size_t group, const int k) const
  {
    const auto g = static_cast<Eigen::Index>(group);
    return 0.5 * (box_.lower[g] + box_.upper[g]) +
           0.5 * (box_.upper[g] - box_.lower[g]) * chebyshev_node(k, n_nodes_[group]);
  }

  Eigen::VectorXd NodeGrid::node(const std::size_t index) const
  {
    const std::vector<int> k = this->index(index);
    Eigen::VectorXd        place(box_.lower.size());
    for (std::size_t g = 0; g < k.size(); ++g)
      place[static_cast<Eigen::Index>(g)] = coordinate(g, k[g]);
    return place;
  }

  std::optional<GroupBox> NodeGrid::without(const std::vector<std::size_t> &failed, const Eigen::VectorXd &place) const
  {
    IndexBox kept, core;
    for (std::size_t g = 0; g < n_nodes_.size(); ++g)
    {
      const int last = n_nodes_[g] - 1;
      int       k    = 0;
      while (k + 1 < last && coordinate(g, k + 1) <= place[static_cast<Eigen::Index>(g)])
        ++k;
      kept.first.push_back(0);
      kept.last.push_back(last);
      core.first.push_back(k);
      core.last.push_back(std::min(k + 1, last));
    }
    std::vector<Index> inside;
    for (const std::size_t i : failed)
      inside.push_back(index(i));
    while (!inside.empty())
    {
      const Layer worst = worst_outer_layer(kept, core, inside);
      if (worst.share_of_failed == 0.)
        return {};
      if (worst.node == kept.first[worst.group])
        ++kept.first[worst.group];
      else
        --kept.last[worst.group];
      std::erase_if(inside, [&](const Index &k) { return k[worst.group] == worst.node; });
    }
    GroupBox left = box_;
    for (std::size_t g = 0; g < n_nodes_.size(); ++g)
    {
      left.lower[static_cast<Eigen::Index>(g)] = coordinate(g, kept.first[g]);
      left.upper[static_cast<Eigen::Index>(g)] = coordinate(g, kept.last[g]);
    }
    return left;
  }
} // namespace swimtwin
