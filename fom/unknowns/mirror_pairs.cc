#include <fom/unknowns/mirror_pairs.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  MirrorPairs<dim>::MirrorPairs(const SimplexMesh<dim> &mesh, const std::vector<unsigned int> &image_of_vertex)
      : n_vertices_(mesh.n_vertices())
  {
    if (image_of_vertex.empty())
      return;
    // Of two vertices the image has the larger number; an edge is an image if one of its ends is.
    std::vector<unsigned int> partner = image_of_vertex;
    for (const auto &[a, b] : mesh.edges())
      partner.push_back(mesh.edge_node(image_of_vertex[a], image_of_vertex[b]));
    const auto is_lower = [&](const unsigned int node) {
      if (node < n_vertices_)
        return partner[node] < node;
      const auto &[a, b] = mesh.edges()[node - n_vertices_];
      return partner[a] < a || partner[b] < b;
    };
    for (unsigned int node = 0; node < partner.size(); ++node)
    {
      image_.push_back(is_lower(node) ? node : partner[node]);
      original_.push_back(is_lower(node) ? partner[node] : node);
    }
  }

  template <int dim>
  bool MirrorPairs<dim>::is_image(const CellNodes<dim> &cell) const
  {
    return exist() && std::any_of(cell.begin(), cell.end(), [this](const unsigned int node) { return is_image(node); });
  }

  template <int dim>
  void MirrorPairs<dim>::describe(MotionMap<dim> &map, const NodeNumbering<dim> &numbering, const bool with_pressure,
                                  const unsigned int first_row) const
  {
    for (unsigned int node = 0; node < image_.size(); ++node)
    {
      const unsigned int original = original_[node];
      const auto         row      = [&](const unsigned int a, const unsigned int c) {
        return first_row + numbering.vector_index(a, c);
      };
      if (is_image(node))
      {
        for (unsigned int c = 0; c < dim; ++c)
          map.reflect(row(node, c), row(original, c), c == dim - 1 ? -1. : 1.);
        if (with_pressure && node < n_vertices_)
          map.reflect(first_row + numbering.pressure_index(node), first_row + numbering.pressure_index(original), 1.);
      }
      else if (image_[node] == node)
        map.impose(row(node, dim - 1));
    }
  }

  template <int dim>
  void MirrorPairs<dim>::complete(std::vector<double> &force, const NodeNumbering<dim> &numbering) const
  {
    for (unsigned int node = 0; node < image_.size(); ++node)
    {
      const unsigned int image = image_[node];
      if (is_image(node))
        continue;
      for (unsigned int c = 0; c < dim; ++c)
      {
        const double sign  = c == dim - 1 ? -1. : 1.;
        double      &here  = force[numbering.vector_index(node, c)];
        double      &there = force[numbering.vector_index(image, c)];
        there              = image == node ? here + sign * here : sign * here;
      }
      if (node < n_vertices_)
      {
        const double here                      = force[numbering.pressure_index(node)];
        force[numbering.pressure_index(image)] = image == node ? 2. * here : here;
      }
    }
  }

  template class MirrorPairs<2>;
  template class MirrorPairs<3>;
} // namespace swimtwin
