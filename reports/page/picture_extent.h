// How far the points of a picture with one scale reach.
#pragma once

#include <reports/page/gnuplot.h>

#include <Eigen/Dense>

namespace swimtwin
{
  struct PictureExtent
  {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;

    void add(const Eigen::Vector2d &point)
    {
      low  = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    /// x_min, x_max, y_min, y_max, which the macro one_scale reads.
    void set_in(GnuplotPicture &picture) const
    {
      picture.set("x_min", low.x());
      picture.set("x_max", high.x());
      picture.set("y_min", low.y());
      picture.set("y_max", high.y());
    }
  };
} // namespace swimtwin
