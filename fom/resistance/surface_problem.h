// The Stokes flows around a body whose surface moves in given ways: one factorisation, many right-hand sides.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>

namespace swimtwin
{
  /// Velocities of the surface's nodes in one motion, laboratory frame.
  template <int dim>
  using SurfaceVelocity = std::vector<dealii::Tensor<1, dim>>;

  /// Of the unit motions in the plane of x and y, in the order R^T U, omega (about the head's centre), then the modes.
  template <int dim>
  std::vector<SurfaceVelocity<dim>> surface_velocities(const Swimmer<dim>                 &swimmer,
                                                       const Configuration<dim>           &configuration,
                                                       const std::vector<NodalField<dim>> &modes);

  /// The fluid's system with the body's surface held; each motion is a right-hand side. The domain must outlive it.
  template <int dim>
  class SurfaceProblem
  {
  public:
    /// `closed`: no wall without traction, so that the pressure's level is free. Collective.
    SurfaceProblem(const FluidDomain<dim> &fluid, bool closed);

    struct Response
    {
      std::vector<double> force;              ///< on the fluid at all rows; right at those of the surface
      double              mean_pressure = 0.; ///< Pa; of a closed domain, where its level means nothing
    };

    /// Response to each motion. `area_rates` of the body by each motion are taken up by the fluid if the domain is
    /// closed. Throws ComputationError.
    std::vector<Response> respond(const std::vector<SurfaceVelocity<dim>> &motions,
                                  const std::vector<double>               &area_rates);

    /// Values of the fluid's rows in each motion. Throws ComputationError.
    std::vector<std::vector<double>> flows(const std::vector<SurfaceVelocity<dim>> &motions,
                                           const std::vector<double>               &area_rates);
    /// Values of the fluid's rows under loads on all rows, the surface at rest. Throws ComputationError.
    std::vector<std::vector<double>> flows_under(const std::vector<std::vector<double>> &loads);

  private:
    /// Rows' values: those at the surface, and the others from unknowns, if there are any yet.
    std::vector<double> values(const SurfaceVelocity<dim> &motion, const std::vector<double> *unknowns) const;
    std::vector<double> load(const SurfaceVelocity<dim> &motion, double area_rate) const;
    std::vector<std::vector<double>> solved(const std::vector<SurfaceVelocity<dim>> &motions,
                                            const std::vector<double>               &area_rates);

    const FluidDomain<dim> &fluid_;
    MotionMap<dim>          map_;
    Condensation<dim>       condensation_;
    LinearSystem            solver_;
    std::vector<double>     load_of_source_; ///< of a unit source spread over the fluid; zero in an open domain
  };
} // namespace swimtwin
