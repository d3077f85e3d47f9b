// Where the head is and how it is turned; the frame in which the tail's shape is described.
#pragma once

#include <Eigen/Geometry>
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

  /// r x f.
  template <int dim>
  AngularVelocity<dim> torque_of_force(const dealii::Tensor<1, dim> &r, const dealii::Tensor<1, dim> &f)
  {
    AngularVelocity<dim> torque;
    if constexpr (dim == 2)
      torque[0] = r[0] * f[1] - r[1] * f[0];
    else
      torque = rotational_velocity<3>(r, f);
    return torque;
  }

  /// The rotation of a motion in the plane of x and y, among `AngularVelocity`.
  template <int dim>
  constexpr int rotation_about_z = n_rotations<dim> - 1;

  /// The velocities (translations, then rotations) of a motion in that plane.
  template <int dim>
  const std::vector<int> motions_in_plane{0, 1, dim + rotation_about_z<dim>};

  /// How many these are.
  constexpr int n_rigid_in_plane = 3;

  /// Velocity at X of a body that moves by the k-th of them with unit velocity, in its own frame.
  template <int dim>
  dealii::Tensor<1, dim> unit_motion_in_plane(const int k, const dealii::Tensor<1, dim> &X)
  {
    dealii::Tensor<1, dim> velocity;
    if (k < 2)
    {
      velocity[k] = 1.;
      return velocity;
    }
    AngularVelocity<dim> omega;
    omega[rotation_about_z<dim>] = 1.;
    return rotational_velocity<dim>(omega, X);
  }

  /// Which of x, y and z a rotation is about.
  template <int dim>
  constexpr int axis_of_rotation(const int k)
  {
    return k + 3 - n_rotations<dim>;
  }

  /// How the head frame is turned: in a plane an unwrapped angle (rad), in space a unit quaternion. Both are turned by
  /// rotation vectors (rad, laboratory), exp(v) R, and a turn from one to another is one: log(R R_other^T).
  template <int dim>
  struct Attitude;

  template <>
  struct Attitude<2>
  {
    double angle = 0.;

    static Attitude about_z(const double angle_rad) { return {angle_rad}; }

    void               turn(const AngularVelocity<2> &rotation) { angle += rotation[0]; }
    AngularVelocity<2> turn_from(const Attitude &other) const
    {
      AngularVelocity<2> rotation;
      rotation[0] = angle - other.angle;
      return rotation;
    }
    /// Of the head frame's x in the plane of x and y, from the laboratory's (rad); of full turns in a plane alone.
    double heading() const { return angle; }

    /// R: from the head frame to the laboratory.
    dealii::Tensor<2, 2> rotation() const
    {
      dealii::Tensor<2, 2> r;
      r[0][0] = r[1][1] = std::cos(angle);
      r[1][0]           = std::sin(angle);
      r[0][1]           = -r[1][0];
      return r;
    }
    friend bool operator==(const Attitude &, const Attitude &) = default;
  };

  template <>
  struct Attitude<3>
  {
    Eigen::Quaterniond quaternion = Eigen::Quaterniond::Identity();

    static Attitude about_z(const double angle_rad)
    {
      return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()))};
    }

    void turn(const AngularVelocity<3> &rotation)
    {
      const Eigen::Vector3d v(rotation[0], rotation[1], rotation[2]);
      if (const double angle = v.stableNorm(); angle > 0.)
        quaternion = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, v / angle)) * quaternion).normalized();
    }
    /// By half a turn at most.
    AngularVelocity<3> turn_from(const Attitude &other) const
    {
      const Eigen::AngleAxisd turn(quaternion * other.quaternion.conjugate());
      AngularVelocity<3>      rotation;
      for (int k = 0; k < 3; ++k)
        rotation[k] = turn.angle() * turn.axis()[k];
      return rotation;
    }
    double heading() const
    {
      const dealii::Tensor<2, 3> r = rotation();
      return std::atan2(r[1][0], r[0][0]);
    }

    dealii::Tensor<2, 3> rotation() const
    {
      const Eigen::Matrix3d m = quaternion.toRotationMatrix();
      dealii::Tensor<2, 3>  r;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          r[i][j] = m(i, j);
      return r;
    }
    friend bool operator==(const Attitude &a, const Attitude &b)
    {
      return a.quaternion.coeffs() == b.quaternion.coeffs();
    }
  };

  /// Position of the head's centre (m) and attitude of the head frame.
  template <int dim>
  struct RigidPose : Attitude<dim>
  {
    dealii::Point<dim> center;

    void set_attitude(const Attitude<dim> &attitude) { static_cast<Attitude<dim> &>(*this) = attitude; }

    /// Laboratory position of a point of the head frame.
    dealii::Point<dim> to_laboratory(const dealii::Tensor<1, dim> &x) const { return center + this->rotation() * x; }
    /// Head-frame coordinates of a laboratory position.
    dealii::Point<dim> to_head_frame(const dealii::Point<dim> &x) const
    {
      return dealii::Point<dim>(transpose(this->rotation()) * (x - center));
    }
    friend bool operator==(const RigidPose &a, const RigidPose &b)
    {
      return static_cast<const Attitude<dim> &>(a) == b && a.center == b.center;
    }
  };
} // namespace swimtwin
