// Meshes that are their own mirror images: which node is whose image, and what that ties together.
#pragma once

#include <fom/geometry/simplex_mesh.h>
#include <fom/unknowns/motion_map.h>

namespace swimtwin
{
  /// Nodes of a mesh that is its own mirror image (see reflect()) in pairs. Numbers alone say who belongs together,
  /// never positions.
  template <int dim>
  class MirrorPairs
  {
  public:
    /// Of a mesh that is no such mirror image: no pairs, and every cell stands for itself.
    MirrorPairs() = default;
    /// `image_of_vertex` as `reflect` gives it, or empty.
    MirrorPairs(const SimplexMesh<dim> &mesh, const std::vector<unsigned int> &image_of_vertex);

    bool exist() const { return !image_.empty(); }
    /// Whether the cell is an image, so that nothing of it needs to be computed.
    bool is_image(const CellNodes<dim> &cell) const;
    /// How many cells one that is no image stands for.
    double weight() const { return exist() ? 2. : 1.; }

    /// Tie the rows of every image to those of its original, and keep the nodes on the plane there. `first_row` is the
    /// row of the numbering's first index. Comes last in the description of a map.
    void describe(MotionMap<dim> &map, const NodeNumbering<dim> &numbering, bool with_pressure,
                  unsigned int first_row = 0) const;
    /// Complete nodal forces (by the numbering of a fluid) to which the originals' cells alone have contributed.
    void complete(std::vector<double> &force, const NodeNumbering<dim> &numbering) const;

  private:
    bool is_image(const unsigned int node) const { return original_[node] != node; }

    unsigned int              n_vertices_ = 0;
    std::vector<unsigned int> image_;    ///< of every node: itself for images and on the plane
    std::vector<unsigned int> original_; ///< of every node: itself for originals and on the plane
  };
} // namespace swimtwin
