// How far the points of a picture with one scale reach.
#pragma once

#include <reports/page/gnuplot.h>

#include <Eigen/Dense>

#include <limits>

namespace swimtwin
{
  /// Smallest box around points; never smaller than `least`, so that a body at rest can be drawn too.
  class PictureExtent
  {
  public:
    explicit PictureExtent(const double least = 0.) : least_(least) {}

    void            add(const Eigen::Vector2d &point);
    double          size() const; ///< the larger side
    Eigen::Vector2d center() const { return 0.5 * (low_ + high_); }
    /// x_min, x_max, y_min, y_max, which the macro one_scale reads.
    void set_in(GnuplotPicture &picture) const;

  private:
    double          least_;
    Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
  };
} // namespace swimtwin
