#include <fom/meshing/graded_size.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <memory>

namespace swimtwin
{
  using namespace dealii;

  SpatialSizeField graded_size(const std::vector<std::pair<Point<3>, double>> &prescribed, const double growth,
                               const double largest)
  {
    using Tree      = decltype(pack_rtree(prescribed));
    const auto tree = std::make_shared<const Tree>(pack_rtree(prescribed));
    return [=](const Point<3> &x) {
      double size = largest;
      for (const auto &[point, h] :
           *tree | boost::geometry::index::adaptors::queried(boost::geometry::index::nearest(x, 1)))
        size = std::min(size, h + growth * point.distance(x));
      return size;
    };
  }

  SpatialSizeField scaled(const SpatialSizeField &size, const double factor)
  {
    return [=](const Point<3> &x) { return factor * size(x); };
  }
} // namespace swimtwin
