// How the fluid's mesh follows the swimmer: an extension of the boundary displacement into the fluid.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/geometry/simplex_mesh.h>
#include <fom/unknowns/condensation.h>
#include <fom/unknowns/mirror_pairs.h>

#include <memory>

namespace swimtwin
{
  /// Solves one linear problem on the mesh as it was made, so that a mesh is a function of the boundary's displacement
  /// alone, whatever the path to it, and one factorisation serves until the next remeshing.
  ///
  /// Vertices carry the unknowns; mid-edge nodes stay in the middle, so that only edges on the boundary are curved.
  ///
  /// elastic: linear elasticity, stiffness 1/d^2 with d the distance to the swimmer (at least the cell's size);
  /// weighted harmonic: Laplacian with weight 1 + tau, tau = (1 - V_min/V_max)/(V/V_max) of the cell's volume V
  /// (Masud and Hughes 1997; Kanchi and Masud 2007), the reference study's law; harmonic: Laplacian.
  template <int dim>
  class MeshExtension
  {
  public:
    /// `moving_nodes`: nodes whose displacement will be prescribed, `still_nodes`: nodes that stay. A mesh of mirror
    /// pairs moves as such. `solver`: factors, or conjugate gradients with multigrid. Collective.
    MeshExtension(const SimplexMesh<dim> &mesh, const NodeNumbering<dim> &numbering, MeshMotion law,
                  std::vector<unsigned int> moving_nodes, const std::vector<unsigned int> &still_nodes,
                  const MirrorPairs<dim> &mirror_pairs = {}, LinearSolver solver = LinearSolver::direct);

    /// Displacement of every node for prescribed displacements of the moving nodes. Collective. An empty result means
    /// that the solve failed.
    std::vector<dealii::Tensor<1, dim>> extend(const std::vector<dealii::Tensor<1, dim>> &displacement);

    const LinearSolverCounts &counts() const { return system_.counts(); }

  private:
    struct BoundaryCell
    {
      std::vector<unsigned int>        rows;
      std::vector<std::vector<double>> matrix;
    };
    void assemble(MeshMotion law, const MirrorPairs<dim> &mirror_pairs);

    const SimplexMesh<dim>   &mesh_;
    const NodeNumbering<dim> &numbering_;
    std::vector<unsigned int> moving_nodes_;
    MotionMap<dim>            map_;
    Condensation<dim>         condensation_;
    LinearSystem              system_;
    std::vector<BoundaryCell> boundary_cells_; ///< owned cells that touch moving nodes, for the right-hand side
    std::vector<double>       last_solution_;
  };
} // namespace swimtwin
