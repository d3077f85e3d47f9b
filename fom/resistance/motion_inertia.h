// Inertia of fluid and tail against motions of the body: the acceleration projected on the Stokes flows that the
// motions drive (docs/equations.md, section 14).
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>

#include <deal.II/lac/full_matrix.h>

namespace swimtwin
{
  /// Motions of the body in the plane of x and y: R^T U, omega (about the head's centre), then the modes; `modes` are
  /// fields on the tail's nodes in the head's frame, and slopes[j][k] is how mode j changes as the body moves along
  /// mode k.
  template <int dim>
  struct BodyMotions
  {
    std::vector<NodalField<dim>>              modes;
    std::vector<std::vector<NodalField<dim>>> slopes;
  };

  /// With velocities xi the inertia answers by the force M dxi/dt + (xi . quadratic_i xi)_i; for unit density, SI, per
  /// unit depth in 2D.
  template <int dim>
  struct MotionInertia
  {
    dealii::FullMatrix<double>              mass;        ///< M, symmetric
    std::vector<dealii::FullMatrix<double>> quadratic;   ///< one symmetric matrix per force
    std::vector<dealii::FullMatrix<double>> mass_slopes; ///< dM along each motion of unit velocity

    /// What the rate of kinetic energy leaves of the quadratic forces: quadratic less half of dM/dt xi. Its power
    /// xi . remainder vanishes for flows without outflow, and is taken off: it comes from the discretisation, and from
    /// what leaves through open walls.
    std::vector<dealii::FullMatrix<double>> powerless() const;
    /// That power's size, relative to the quadratic forces' (largest entries).
    double power_defect() const;
  };

  /// Of the fluid on its mesh as it is, which must fit this configuration: rho int (du/dt + u . grad u) . u_i
  /// of u = sum xi_j u_j, u_i the Stokes flow of motion i. By the reciprocal theorem that is the fluid's force of
  /// inertia to first order in the density. Collective; throws ComputationError.
  template <int dim>
  MotionInertia<dim> compute_fluid_inertia(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                           const Configuration<dim> &configuration, const BodyMotions<dim> &motions);

  /// Of the tail: rho int a . v_i, exact for these motions.
  template <int dim>
  MotionInertia<dim> compute_tail_inertia(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                          const BodyMotions<dim> &motions);
} // namespace swimtwin
