#include <fom/geometry/reflection.h>

namespace swimtwin
{
  using namespace dealii;

  SimplexSoup<2> reflect(const SimplexSoup<2> &upper, const double plane_y, std::vector<unsigned int> &image)
  {
    SimplexSoup<2> whole = upper;
    image.clear();
    for (unsigned int v = 0; v < upper.vertices.size(); ++v)
      if (upper.vertices[v][1] == plane_y)
        image.push_back(v);
      else
      {
        image.push_back(whole.vertices.size());
        whole.vertices.push_back(mirrored(upper.vertices[v], plane_y));
      }
    for (const auto &[a, b, c] : upper.cells)
      whole.cells.push_back({image[a], image[c], image[b]});
    image.resize(whole.vertices.size());
    for (unsigned int v = 0; v < upper.vertices.size(); ++v)
      image[image[v]] = v;
    return whole;
  }
} // namespace swimtwin
