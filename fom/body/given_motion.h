// Motions that a scene prescribes: of the head, and of the tail's shape.
#pragma once

#include <fom/body/swimmer.h>

namespace swimtwin
{
  /// Where a prescribed head is at a time, and how fast; it turns about z.
  template <int dim>
  struct GivenPose
  {
    RigidPose<dim>         pose;
    dealii::Tensor<1, dim> velocity;
    AngularVelocity<dim>   omega;
  };
  template <int dim>
  GivenPose<dim> given_pose(const Head &head, double time_s);

  /// Displacements (m, head frame) of the tail's nodes in its prescribed bending: cross sections stay plane, normal to
  /// the axis and as high as they are, so that the area stays, too.
  template <int dim>
  NodalField<dim> given_shape(const Swimmer<dim> &swimmer, double time_s);

  /// What is prescribed at a time, in the place of what stands there.
  template <int dim>
  void take_given_configuration(const Swimmer<dim> &swimmer, double time_s, Configuration<dim> &configuration);
} // namespace swimtwin
