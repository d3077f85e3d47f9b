// The tail's axis as a curve: where its points are, and how they move with the shape.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/shape_amplitudes.h>

#include <vector>

namespace swimtwin
{
  /// Points of the axis by their share of its length at rest: 0 at the head's surface, 1 at the tip. Linear between the
  /// mesh's nodes on the axis.
  class TailAxis
  {
  public:
    /// Throws InputError for a model whose mesh has no nodes on the axis.
    explicit TailAxis(const ReducedTail &tail);

    /// In the head's frame.
    Eigen::Vector2d position_m(double share, const ShapeVector &q) const;
    /// Position, and its derivative by the shape, 2 x r.
    Eigen::Vector2d position_m(double share, const ShapeVector &q,
                               Eigen::Ref<Eigen::Matrix<double, 2, Eigen::Dynamic>> slopes) const;
    /// The share of the point of the axis that is nearest to a point of the head's frame.
    double nearest(const Eigen::Vector2d &point_m, const ShapeVector &q) const;

  private:
    using ModeRows = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, max_amplitudes>;
    struct Node
    {
      Eigen::Vector2d place_m;
      ModeRows        modes; ///< 2 x (r + s)
    };
    struct Place
    {
      std::size_t left   = 0;
      double      weight = 0.; ///< of the node after it
    };
    Place find(double share) const;

    ShapeAmplitudes   amplitudes_;
    std::vector<Node> nodes_; ///< from the root to the tip
  };
} // namespace swimtwin
