// The tail's tip in the head's frame: where it is and where it points.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/shape_amplitudes.h>

#include <array>

namespace swimtwin
{
  class TailTip
  {
  public:
    explicit TailTip(const ReducedTail &tail);

    Eigen::Vector2d position_m(const ShapeVector &q) const;
    /// Of the tangent of the tail's material axis at the tip, the derivative at its end of the quadratic through the
    /// axis' last edge; from the head's +x, in (-pi, pi].
    double angle_rad(const ShapeVector &q) const;

  private:
    struct Node
    {
      Eigen::Vector2d  place_m;
      Eigen::Matrix2Xd modes;
      Eigen::Vector2d  position(const AmplitudeVector &p) const { return place_m + modes * p; }
    };

    ShapeAmplitudes     amplitudes_;
    std::array<Node, 3> last_edge_; ///< its other end, its middle, the tip
  };
} // namespace swimtwin
