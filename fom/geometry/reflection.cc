#include <fom/geometry/reflection.h>

#include <array>
#include <map>

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

  template <int dim>
  std::optional<std::vector<unsigned int>> images_of_nodes(const SimplexMesh<dim> &mesh)
  {
    const auto key = [](const Point<dim> &x) {
      std::array<double, dim> place;
      for (int i = 0; i < dim; ++i)
        place[i] = x[i] + 0.; // no negative zero
      return place;
    };
    std::map<std::array<double, dim>, unsigned int> node_at;
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      node_at[key(mesh.nodes[a])] = a;
    std::vector<unsigned int> images;
    for (const auto &node : mesh.nodes)
      if (const auto image = node_at.find(key(mirrored(node))); image != node_at.end())
        images.push_back(image->second);
      else
        return {};
    return images;
  }

  template std::optional<std::vector<unsigned int>> images_of_nodes<2>(const SimplexMesh<2> &);
  template std::optional<std::vector<unsigned int>> images_of_nodes<3>(const SimplexMesh<3> &);
  template SimplexSoup<2> reflect<2>(const SimplexSoup<2> &, double, std::vector<unsigned int> &);
  template SimplexSoup<3> reflect<3>(const SimplexSoup<3> &, double, std::vector<unsigned int> &);
} // namespace swimtwin
