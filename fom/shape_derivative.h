// How the tail's shape answers to a change of the velocities within one time step.
#pragma once

#include <fom/rigid_pose.h>

namespace swimtwin
{
  /// (1 + slope omega x)^-1.
  template <int dim>
  dealii::Tensor<2, dim> inverse_of_step_rotation(const AngularVelocity<dim> &omega, const double slope_weight)
  {
    dealii::Tensor<2, dim> matrix;
    for (int c = 0; c < dim; ++c)
    {
      dealii::Tensor<1, dim> unit;
      unit[c]                             = 1.;
      const dealii::Tensor<1, dim> column = unit + slope_weight * rotational_velocity<dim>(omega, unit);
      for (int i = 0; i < dim; ++i)
        matrix[i][c] = column[i];
    }
    return invert(matrix);
  }

  /// How the shape follows from the velocities in one step: with d = known + slope d' and
  /// w = U + omega x R (X + d) + R d', for nodes that are not clamped,
  ///   dd = slope M (R^T (dw - dU) - domega x r - slope domega x (omega x r + d')),  M = (1 + slope omega x)^-1,
  /// r = X + d in the head's frame. Clamped nodes have dd = 0 (docs/equations.md).
  template <int dim>
  class ShapeDerivative
  {
  public:
    ShapeDerivative(const RigidPose<dim> &pose, const AngularVelocity<dim> &omega, const double slope_weight)
        : slope_(slope_weight), omega_(omega), R_(pose.rotation()),
          M_(inverse_of_step_rotation<dim>(omega, slope_weight))
    {
    }

    const dealii::Tensor<2, dim> &rotation() const { return R_; }
    /// dd/dw = -dd/dU.
    dealii::Tensor<2, dim> by_velocity() const { return slope_ * (M_ * transpose(R_)); }
    /// dd/domega_k.
    dealii::Tensor<1, dim> by_rotation(const int k, const dealii::Tensor<1, dim> &r,
                                       const dealii::Tensor<1, dim> &shape_rate) const
    {
      AngularVelocity<dim> axis;
      axis[k] = 1.;
      return -slope_ *
             (M_ * (rotational_velocity<dim>(axis, r) +
                    slope_ * rotational_velocity<dim>(axis, rotational_velocity<dim>(omega_, r) + shape_rate)));
    }

  private:
    double                 slope_;
    AngularVelocity<dim>   omega_;
    dealii::Tensor<2, dim> R_, M_;
  };
} // namespace swimtwin
