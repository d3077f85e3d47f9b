// Surfaces in space, triangulated patch by patch on plane charts, with quadratic edges.
#pragma once

#include <fom/geometry/planar_curve.h>
#include <fom/meshing/tetrahedralize.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace swimtwin
{
  struct QuadraticSurface
  {
    TriangleSurface                  corners;
    std::map<Edge, dealii::Point<3>> middle;   ///< of every edge
    std::vector<int>                 patch_of; ///< of every triangle

    /// Number of the vertex at a point, bit by bit; a new one if there is none yet.
    unsigned int number_at(const dealii::Point<3> &x);
    /// The same for a point that a patch had on its boundary.
    unsigned int existing_number_at(const dealii::Point<3> &x) const { return numbers_.at({x[0], x[1], x[2]}); }
    /// Add a triangle with its edges; vertices at the same point are one.
    void add(const std::array<dealii::Point<3>, 3> &vertices, const std::array<dealii::Point<3>, 3> &middles,
             int patch);

  private:
    std::map<std::array<double, 3>, unsigned int> numbers_;
  };

  /// A patch of a surface: a plane region whose boundary nodes are given in the plane and in space, and the map.
  struct SurfacePatch
  {
    /// A closed quadratic loop without repetition: vertex, middle, vertex, ...; the first loop is the outer one.
    struct Loop
    {
      std::vector<dealii::Point<2>> chart;
      std::vector<dealii::Point<3>> nodes;

      void append(const dealii::Point<2> &in_chart, const dealii::Point<3> &node)
      {
        chart.push_back(in_chart);
        nodes.push_back(node);
      }
    };
    std::vector<Loop>                                         loops;
    std::function<dealii::Point<3>(const dealii::Point<2> &)> position;
    SizeField                                                 size; ///< in the chart
    int                                                       number = 0;
  };

  /// Triangulate a patch and join it to the surface at boundary vertices that both have. Collective.
  void add_patch(QuadraticSurface &surface, const SurfacePatch &patch, MPI_Comm communicator);

  /// A plane patch whose chart leaves out one of the coordinates.
  SurfacePatch plane_patch(const std::vector<std::vector<dealii::Point<3>>> &loops, int left_out,
                           const SpatialSizeField &size);

  /// In a mesh whose half (z >= 0) has these vertices first, and of which `image` tells every vertex's reflection: put
  /// the middles of the surface's edges, and of their images, where they belong.
  void curve_edges(SimplexMesh<3> &mesh, const QuadraticSurface &half, const std::vector<unsigned int> &image);
} // namespace swimtwin
