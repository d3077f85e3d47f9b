// The fluid: its mesh as it moves, its unknowns, and its share of the coupled system. It never learns what a swimmer
// is.
#pragma once

#include <datasets/scene/inertia_terms.h>
#include <fom/algebra/bdf2.h>
#include <fom/fluid/fluid_inertia.h>
#include <fom/fluid/fluid_motion.h>
#include <fom/fluid/mesh_motion.h>
#include <fom/fluid/streamline_stabilization.h>
#include <fom/mesh/fluid_mesh.h>
#include <fom/unknowns/condensation.h>
#include <fom/unknowns/mirror_pairs.h>

#include <memory>
#include <optional>

namespace swimtwin
{
  /// What the fluid does at one instant (per unit depth in 2D).
  struct FluidReaction
  {
    std::vector<double> force; ///< of every row on the fluid: the residual of the weak form, never a boundary integral
    double              dissipation   = 0.; ///< 2 mu D:D integrated (W)
    double              wall_power    = 0.; ///< of moving walls and inflows on the fluid (W)
    double              stabilization = 0.; ///< what the streams' stabilisation dissipates (W)
    KineticPowers       kinetic;
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

    /// Rows of a cell: velocities node by node, then the vertices' pressures.
    std::vector<unsigned int> cell_rows(unsigned int cell) const;
    /// Whether the pressure's level is fixed by a wall without traction.
    bool has_free_boundary() const { return scene_.domain->has_traction_free_wall(); }

    /// Mark the rows at walls, and one pressure if nothing else fixes its level, as imposed.
    void describe(MotionMap<dim> &map, bool pin_pressure) const;
    /// Tie the rows of images to their originals; comes last. Nothing to do on a mesh that is no mirror image.
    void describe_mirror(MotionMap<dim> &map) const { mirror_pairs_.describe(map, numbering_, true); }
    void set_wall_velocities(MotionMap<dim> &map, double time_s) const;

    /// Let the mesh follow the swimmer's surface (laboratory positions). Returns the worst element quality, <= 0
    /// with an element inside out, or nothing where the mesh's motion could not be solved: it then stays where it was.
    /// Collective.
    std::optional<double> follow(const std::vector<dealii::Point<dim>> &surface, const RigidPose<dim> &pose);
    double                quality() const { return quality_; }

    // Inertia: the past is kept where a term needs it, and starts from rest.
    const InertiaTerms   &inertia() const { return terms_; }
    const FluidPast<dim> &past() const { return past_; }
    void                  set_past(FluidPast<dim> past) { past_ = std::move(past); }
    /// Time steps of y(t + dt) = known + slope_weight y'(t + dt) begin here.
    void begin_step(const Bdf2 &bdf);
    /// The step is over, at the present position and with these values of the rows.
    void end_step(const std::vector<double> &values);
    /// Whether the convective term is solved for, which makes the matrix unsymmetric; else it is taken from the
    /// iterate.
    bool solves_for_convection() const { return solves_for_convection_; }
    /// Distance between two flows, as the root mean square over the nodes (m/s); from rest without a second one.
    double distance(const std::vector<double> &values, const std::vector<double> &others = {}) const;

    /// Add the fluid's cells to an assembly: once to describe them, then at every new position or time.
    void add_cells(Condensation<dim> &condensation) const;
    /// `source`: rate at which volume is to appear in the fluid, spread evenly (m^2/s in 2D). `iterate`: values of the
    /// rows at which the convective term is linearised, where there is one.
    void assemble(Condensation<dim> &condensation, double source = 0., const std::vector<double> &iterate = {}) const;

    /// Diagonal of the pressures' mass matrix over the viscosity, of this rank's cells; zero at other rows.
    std::vector<double> pressure_masses() const;

    /// From the rows' values. Collective.
    FluidReaction react(const std::vector<double> &values) const;
    /// The same forces (and divergences at the pressures' rows) for the price of the cells at the swimmer's surface:
    /// right at the surface's rows, and everywhere if the values are zero off it. Collective.
    std::vector<double> force_on_fluid_at_surface(const std::vector<double> &values) const;

    /// Pressure in Pa is the row's value times this.
    double pressure_scale() const { return pressure_scale_; }

    const FluidMesh<dim>     &fluid_mesh() const { return fluid_mesh_; }
    const SimplexMesh<dim>   &mesh() const { return fluid_mesh_.mesh; }
    const NodeNumbering<dim> &numbering() const { return numbering_; }
    /// This rank's cells, without images: each stands for as many as the mirror pairs' weight says.
    const std::vector<unsigned int>       &owned_cells() const { return owned_cells_; }
    const MirrorPairs<dim>                &mirror_pairs() const { return mirror_pairs_; }
    const std::vector<dealii::Point<dim>> &positions() const { return positions_; }
    const RigidPose<dim>                  &pose_at_meshing() const { return pose_at_meshing_; }
    LinearSolverCounts mesh_motion_counts() const { return extension_ ? extension_->counts() : LinearSolverCounts(); }

  private:
    /// What a cell's convection needs at a flow; none for most.
    std::optional<StreamlineStabilization<dim>> stabilization(const CellFlow<dim> &flow) const
    {
      return StreamlineStabilization<dim>::of(map_, step_inertia(), flow, scene_.fluid->viscosity_Pa_s);
    }
    /// Sum up the forces and powers of some cells and of those they stand for, over all ranks. Collective.
    FluidReaction sum_forces(const std::vector<unsigned int> &cells, const std::vector<double> &values) const;
    CellFlow<dim> cell_flow(unsigned int cell, const std::vector<double> &values) const;
    bool          convection_is_mild() const;
    FluidInertia  step_inertia() const
    {
      return {scene_.fluid->density_kg_m3, terms_.unsteady && slope_weight_ > 0. ? 1. / slope_weight_ : 0.,
              terms_.convective};
    }

    const Scene                        &scene_;
    FluidMesh<dim>                      fluid_mesh_;
    NodeNumbering<dim>                  numbering_;
    MirrorPairs<dim>                    mirror_pairs_; ///< of a mesh that is its own mirror image
    RigidPose<dim>                      pose_at_meshing_;
    std::unique_ptr<MeshExtension<dim>> extension_; ///< made when the swimmer first moves
    std::vector<dealii::Point<dim>>     positions_;
    std::vector<unsigned int>           owned_cells_, owned_cells_at_surface_; ///< no images
    std::vector<char>                   is_at_surface_;                        ///< of the swimmer, by node
    double                              pressure_scale_, quality_, volume_ = 0.;
    mutable IsoparametricCell<dim>      map_;

    InertiaTerms     terms_;
    FluidPast<dim>   past_;
    FluidMotion<dim> known_;                      ///< of the step, with its formula's weights
    double           slope_weight_          = 0.; ///< s
    bool             solves_for_convection_ = false;
  };
} // namespace swimtwin
