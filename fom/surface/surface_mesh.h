// The closed surface of a body as quadratic faces.
#pragma once

#include <fom/geometry/rigid_pose.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace swimtwin
{
  /// 2D: vertex, middle, vertex along the curve; 3D: three vertices, then the middles of edges 01, 12, 20.
  template <int dim>
  constexpr unsigned int n_face_nodes = dim == 2 ? 3 : 6;

  template <int dim>
  using FaceNodes = std::array<unsigned int, n_face_nodes<dim>>;

  /// Faces run such that their normals point out of the body.
  template <int dim>
  struct SurfaceMesh
  {
    std::vector<dealii::Point<dim>> nodes; ///< at rest
    std::vector<FaceNodes<dim>>     faces;
  };

  /// Volume (m^3; m^2 in 2D) that the faces enclose with their nodes at x, and the rate at which nodes moving with v
  /// change it. Exact for quadratic faces.
  template <int dim>
  double enclosed_volume(const std::vector<FaceNodes<dim>> &faces, const std::vector<dealii::Tensor<1, dim>> &x);
  template <int dim>
  double enclosed_volume_rate(const std::vector<FaceNodes<dim>> &faces, const std::vector<dealii::Tensor<1, dim>> &x,
                              const std::vector<dealii::Tensor<1, dim>> &v);

  /// Share of the surface at rest that is a node's: the weights of a mean over it; they add up to one.
  template <int dim>
  std::vector<double> surface_shares(const SurfaceMesh<dim> &surface);

  template <>
  double enclosed_volume<2>(const std::vector<FaceNodes<2>> &, const std::vector<dealii::Tensor<1, 2>> &);
  template <>
  double enclosed_volume<3>(const std::vector<FaceNodes<3>> &, const std::vector<dealii::Tensor<1, 3>> &);
  template <>
  double enclosed_volume_rate<2>(const std::vector<FaceNodes<2>> &, const std::vector<dealii::Tensor<1, 2>> &,
                                 const std::vector<dealii::Tensor<1, 2>> &);
  template <>
  double enclosed_volume_rate<3>(const std::vector<FaceNodes<3>> &, const std::vector<dealii::Tensor<1, 3>> &,
                                 const std::vector<dealii::Tensor<1, 3>> &);
  template <>
  std::vector<double> surface_shares<2>(const SurfaceMesh<2> &);
  template <>
  std::vector<double> surface_shares<3>(const SurfaceMesh<3> &);
} // namespace swimtwin
