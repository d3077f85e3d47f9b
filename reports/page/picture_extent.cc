#include <reports/page/picture_extent.h>

#include <algorithm>

namespace swimtwin
{
  void PictureExtent::add(const Eigen::Vector2d &point)
  {
    low_  = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
  }

  double PictureExtent::size() const
  {
    return std::max(least_, (high_ - low_).maxCoeff());
  }

  void PictureExtent::set_in(GnuplotPicture &picture) const
  {
    const double margin = 0.5 * (size() - (high_ - low_).maxCoeff());
    picture.set("x_min", low_.x() - margin);
    picture.set("x_max", high_.x() + margin);
    picture.set("y_min", low_.y() - margin);
    picture.set("y_max", high_.y() + margin);
  }
} // namespace swimtwin
