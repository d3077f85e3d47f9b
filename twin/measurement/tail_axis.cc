#include <datasets/system/error.h>
#include <twin/measurement/tail_axis.h>

#include <algorithm>

namespace swimtwin
{
  TailAxis::TailAxis(const ReducedTail &tail) : amplitudes_(tail)
  {
    const double tolerance = 1e-9 * tail.nodes_m.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < tail.nodes_m.rows(); ++i)
      if (tail.nodes_m.row(i).tail(tail.dimension() - 1).cwiseAbs().maxCoeff() <= tolerance)
        nodes_.push_back({tail.nodes_m.row(i).head<2>().transpose(), tail.modes_in_plane(i)});
    if (nodes_.size() < 2)
      throw InputError("the reduced model's mesh has no nodes on the tail's axis; train it again, with a mesh that is "
                       "its own mirror image.");
    std::sort(nodes_.begin(), nodes_.end(), [](const Node &a, const Node &b) { return a.place_m.x() < b.place_m.x(); });
  }

  TailAxis::Place TailAxis::find(const double share) const
  {
    const double root = nodes_.front().place_m.x(), tip = nodes_.back().place_m.x();
    const double x     = root + std::clamp(share, 0., 1.) * (tip - root);
    const auto   after = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, x,
                                          [](const double value, const Node &n) { return value < n.place_m.x(); });
    const Node  &left = *std::prev(after), &right = *after;
    return {static_cast<std::size_t>(after - nodes_.begin()) - 1,
            (x - left.place_m.x()) / (right.place_m.x() - left.place_m.x())};
  }

  Eigen::Vector2d TailAxis::position_m(const double share, const ShapeVector &q) const
  {
    const auto [left, weight] = find(share);
    const AmplitudeVector p   = amplitudes_.value(q);
    const auto            at  = [&](const Node &node) { return Eigen::Vector2d(node.place_m + node.modes * p); };
    return (1. - weight) * at(nodes_[left]) + weight * at(nodes_[left + 1]);
  }

  Eigen::Vector2d TailAxis::position_m(const double share, const ShapeVector &q,
                                       Eigen::Ref<Eigen::Matrix<double, 2, Eigen::Dynamic>> slopes) const
  {
    const auto [left, weight] = find(share);
    const ModeRows modes      = (1. - weight) * nodes_[left].modes + weight * nodes_[left + 1].modes;
    slopes.noalias()          = modes.lazyProduct(amplitudes_.slopes(q));
    return position_m(share, q);
  }

  double TailAxis::nearest(const Eigen::Vector2d &point_m, const ShapeVector &q) const
  {
    const AmplitudeVector p    = amplitudes_.value(q);
    const double          root = nodes_.front().place_m.x(), tip = nodes_.back().place_m.x();
    double                best = 0., least = std::numeric_limits<double>::infinity();
    Eigen::Vector2d       a = nodes_.front().place_m + nodes_.front().modes * p;
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
    {
      const Eigen::Vector2d b = nodes_[i + 1].place_m + nodes_[i + 1].modes * p, along = b - a;
      const double          weight = std::clamp((point_m - a).dot(along) / along.squaredNorm(), 0., 1.);
      const double          square = (a + weight * along - point_m).squaredNorm();
      if (square < least)
      {
        least = square;
        best  = ((1. - weight) * nodes_[i].place_m.x() + weight * nodes_[i + 1].place_m.x() - root) / (tip - root);
      }
      a = b;
    }
    return best;
  }
} // namespace swimtwin
