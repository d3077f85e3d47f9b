// The fluid around a body that is put into many shapes and poses.
#pragma once

#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <fom/fluid/fluid_domain.h>

#include <memory>

namespace swimtwin
{
  /// In the plane it is meshed anew for each. In space meshes are coarser, so that what is computed would jump from one
  /// to the next: there the mesh that is made around the body at rest follows it, as it does in a run, and a new one is
  /// made only where that one would be below [numerics] remesh_quality, or its elements are too bent to compute on.
  template <int dim>
  class PosedFluid
  {
  public:
    /// The swimmer must outlive this.
    explicit PosedFluid(const Swimmer<dim> &swimmer) : swimmer_(swimmer)
    {
      if constexpr (dim == 3)
        following_ = meshed_for(swimmer.configuration_at_rest());
    }

    /// What `compute` makes of the fluid around the body. Throws ComputationError where it cannot be meshed.
    template <typename Compute>
    auto around(const Configuration<dim> &configuration, const Compute &compute)
    {
      if (following_ && following_->follow(swimmer_.surface(configuration), configuration.pose) >=
                            swimmer_.scene().numerics.remesh_quality)
        try
        {
          return compute(*following_);
        }
        catch (const ComputationError &)
        {
          // its elements are too bent
        }
      return compute(*meshed_for(configuration));
    }

  private:
    std::unique_ptr<FluidDomain<dim>> meshed_for(const Configuration<dim> &configuration) const
    {
      return std::make_unique<FluidDomain<dim>>(
          swimmer_.scene(), mesh_for_given_motions(swimmer_, configuration, MPI_COMM_SELF), configuration.pose);
    }

    const Swimmer<dim>               &swimmer_;
    std::unique_ptr<FluidDomain<dim>> following_; ///< in space
  };
} // namespace swimtwin
