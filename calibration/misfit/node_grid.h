// Chebyshev nodes in a box of the groups, and what is left of the box where some of them cannot be computed.
#pragma once

#include <calibration/misfit/motion_groups.h>

#include <optional>
#include <vector>

namespace swimtwin
{
  /// Extrema of the polynomial of degree n - 1, in [-1, 1]; the middle if n is 1.
  double chebyshev_node(int k, int n);

  class NodeGrid
  {
  public:
    NodeGrid(const GroupBox &box, std::vector<int> n_nodes) : box_(box), n_nodes_(std::move(n_nodes)) {}

    std::size_t             size() const;
    const GroupBox         &box() const { return box_; }
    const std::vector<int> &n_nodes() const { return n_nodes_; } ///< per group
    Eigen::VectorXd         node(std::size_t index) const;       ///< the first group fastest

    /// The box without those outer layers of nodes that hold the nodes `failed`, each time the layer that holds most;
    /// the nodes next to `place` on both sides stay. Empty if one of these failed.
    std::optional<GroupBox> without(const std::vector<std::size_t> &failed, const Eigen::VectorXd &place) const;

  private:
    std::vector<int> index(std::size_t i) const; ///< per group
    double           coordinate(std::size_t group, int k) const;

    GroupBox         box_;
    std::vector<int> n_nodes_;
  };
} // namespace swimtwin
