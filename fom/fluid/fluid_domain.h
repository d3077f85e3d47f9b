// The fluid: its mesh as it moves, its unknowns, and its share of the coupled system. It never learns what a swimmer
// is.
#pragma once

#include <fom/algebra/condensation.h>
#include <fom/algebra/mirror_pairs.h>
#include <fom/fluid/mesh_motion.h>
#include <fom/fluid/stokes.h>
#include <fom/mesh/fluid_mesh.h>

#include <memory>

namespace swimtwin
{
  /// What the fluid does at one instant (per unit depth in 2D).
  struct FluidReaction
  {
    std::vector<double> force; ///< of every row on the fluid: the residual of the weak form, never a boundary integral
    double              dissipation; ///< 2 mu D:D integrated (W)
    double              wall_power;  ///< of moving walls and inflows on the fluid (W)
  };

  /// Lives from one remeshing to the next.
  template <int dim>
  class FluidDomain
  {
  public:
    FluidDomain(const Scene &scene, FluidMesh<dim> fluid_mesh, const RigidPose<dim> &pose);

    unsigned int n_rows() const { return numbering_.size(); }
    unsigned int row_owner(const unsigned int row) const { return numbering_.owner(row); }
    /// Row of a velocity component at the k-th node of the swimmer's surface.
    unsigned int surface_row(const unsigned int k, const unsigned int component) const
    {
      return numbering_.vector_index(fluid_mesh_.surface_nodes[k], component);
    }
    unsigned int n_surface_nodes() const { return fluid_mesh_.surface_nodes.size(); }

    /// Mark the rows at walls, and one pressure if nothing else fixes its level, as imposed.
    void describe(MotionMap<dim> &map, bool pin_pressure) const;
    /// Tie the rows of images to their originals; comes last. Nothing to do on a mesh that is no mirror image.
    void describe_mirror(MotionMap<dim> &map) const { mirror_pairs_.describe(map, numbering_, true); }
    void set_wall_velocities(MotionMap<dim> &map, double time_s) const;

    /// Let the mesh follow the swimmer's surface (laboratory positions). Returns the worst element quality; a number
    /// <= 0 means that an element is inverted. Collective.
    double follow(const std::vector<dealii::Point<dim>> &surface, const RigidPose<dim> &pose);
    double quality() const { return quality_; }

    /// Add the fluid's cells to an assembly: once to describe them, then at every new position or time.
    void add_cells(Condensation<dim> &condensation) const;
    /// `source`: rate at which volume is to appear in the fluid, spread evenly (m^2/s in 2D).
    void assemble(Condensation<dim> &condensation, double source = 0.) const;

    /// From the rows' values. Collective.
    FluidReaction react(const std::vector<double> &values) const;
    /// The same forces (and divergences at the pressures' rows) for the price of the cells at the swimmer's surface:
    /// right at the surface's rows, and everywhere if the values are zero off it. Collective.
    std::vector<double> force_on_fluid_at_surface(const std::vector<double> &values) const;

    /// Pressure in Pa is the row's value times this.
    double pressure_scale() const { return pressure_scale_; }

    const FluidMesh<dim>                  &fluid_mesh() const { return fluid_mesh_; }
    const SimplexMesh<dim>                &mesh() const { return fluid_mesh_.mesh; }
    const NodeNumbering<dim>              &numbering() const { return numbering_; }
    const std::vector<dealii::Point<dim>> &positions() const { return positions_; }
    const RigidPose<dim>                  &pose_at_meshing() const { return pose_at_meshing_; }
    LinearSolverCounts mesh_motion_counts() const { return extension_ ? extension_->counts() : LinearSolverCounts(); }

  private:
    std::vector<unsigned int> cell_rows(unsigned int cell) const;
    /// Sum up the forces of some cells and of those they stand for, over all ranks. Returns the dissipation of the
    /// rank's. Collective.
    double sum_forces(const std::vector<unsigned int> &cells, const std::vector<double> &values,
                      std::vector<double> &force) const;

    const Scene                        &scene_;
    FluidMesh<dim>                      fluid_mesh_;
    NodeNumbering<dim>                  numbering_;
    MirrorPairs<dim>                    mirror_pairs_; ///< of a mesh that is its own mirror image
    RigidPose<dim>                      pose_at_meshing_;
    std::unique_ptr<MeshExtension<dim>> extension_; ///< made when the swimmer first moves
    std::vector<dealii::Point<dim>>     positions_;
    std::vector<unsigned int>           owned_cells_, owned_cells_at_surface_; ///< no images
    double                              pressure_scale_, quality_, volume_ = 0.;
    mutable IsoparametricCell<dim>      map_;
  };
} // namespace swimtwin
