// Where the head is and how it is turned; the frame in which the tail's shape is described.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <cmath>
#include <vector>

namespace swimtwin
{
  /// Independent rotations of a rigid body.
  template <int dim>
  constexpr int n_rotations = dim == 2 ? 1 : 3;

  /// Columns of the motion map for a rigid body: translations, then rotations.
  template <int dim>
  constexpr int n_rigid = dim + n_rotations<dim>;

  template <int dim>
  using AngularVelocity = dealii::Tensor<1, n_rotations<dim>>;

  /// omega x r.
  template <int dim>
  dealii::Tensor<1, dim> rotational_velocity(const AngularVelocity<dim> &omega, const dealii::Tensor<1, dim> &r)
  {
    dealii::Tensor<1, dim> v;
    if constexpr (dim == 2)
    {
      v[0] = -omega[0] * r[1];
      v[1] = omega[0] * r[0];
    }
    else
      for (int c = 0; c < 3; ++c)
        v[c] = omega[(c + 1) % 3] * r[(c + 2) % 3] - omega[(c + 2) % 3] * r[(c + 1) % 3];
    return v;
  }

  /// The rotation of a motion in the plane of x and y, among `AngularVelocity`.
  template <int dim>
  constexpr int rotation_about_z = n_rotations<dim> - 1;

  /// The velocities (translations, then rotations) of a motion in that plane.
  template <int dim>
  const std::vector<int> motions_in_plane{0, 1, dim + rotation_about_z<dim>};

  /// Position of the head's centre (m) and unwrapped angle (rad) of the head frame about z. In 3D, motions are planar;
  /// where they will not be, the attitude is a unit quaternion: everything else asks for rotation() and does not know.
  template <int dim>
  struct RigidPose
  {
    dealii::Point<dim> center;
    double             angle = 0.;

    /// R: from the head frame to the laboratory.
    dealii::Tensor<2, dim> rotation() const
    {
      dealii::Tensor<2, dim> r;
      for (int c = 2; c < dim; ++c)
        r[c][c] = 1.;
      r[0][0] = r[1][1] = std::cos(angle);
      r[1][0]           = std::sin(angle);
      r[0][1]           = -r[1][0];
      return r;
    }

    /// Laboratory position of a point of the head frame.
    dealii::Point<dim> to_laboratory(const dealii::Tensor<1, dim> &x) const { return center + rotation() * x; }
    /// Head-frame coordinates of a laboratory position.
    dealii::Point<dim> to_head_frame(const dealii::Point<dim> &x) const
    {
      return dealii::Point<dim>(transpose(rotation()) * (x - center));
    }
  };
} // namespace swimtwin
