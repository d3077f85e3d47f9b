#include <fom/geometry/reflection.h>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  SimplexSoup<dim> reflect(const SimplexSoup<dim> &upper, const double plane, std::vector<unsigned int> &image)
  {
    SimplexSoup<dim> whole = upper;
    image.clear();
    for (unsigned int v = 0; v < upper.vertices.size(); ++v)
      if (upper.vertices[v][dim - 1] == plane)
        image.push_back(v);
      else
      {
        image.push_back(whole.vertices.size());
        whole.vertices.push_back(mirrored(upper.vertices[v], plane));
      }
    for (auto cell : upper.cells)
    {
      for (auto &v : cell)
        v = image[v];
      std::swap(cell[1], cell[2]); // keeps the orientation
      whole.cells.push_back(cell);
    }
    image.resize(whole.vertices.size());
    for (unsigned int v = 0; v < upper.vertices.size(); ++v)
      image[image[v]] = v;
    return whole;
  }

  template SimplexSoup<2> reflect<2>(const SimplexSoup<2> &, double, std::vector<unsigned int> &);
  template SimplexSoup<3> reflect<3>(const SimplexSoup<3> &, double, std::vector<unsigned int> &);
} // namespace swimtwin
