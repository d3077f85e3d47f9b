// The elastic tail: internal forces, their tangent, energy, mass and dead loads on its Lagrangian mesh.
#pragma once

#include <fom/elastic/hyperelasticity.h>
#include <fom/geometry/isoparametric_cell.h>

#include <memory>
#include <vector>

namespace swimtwin
{
  /// Nodal vectors hold one vector per node of the mesh, in the head frame. Per unit depth in 2D.
  template <int dim>
  using NodalField = std::vector<dealii::Tensor<1, dim>>;

  /// Everything is an integral over the reference configuration, so shape gradients and weights are tabulated once.
  template <int dim>
  class ElasticTail
  {
  public:
    static constexpr unsigned int n_cell_dofs = n_cell_nodes<dim> * dim;
    using CellForce                           = std::array<double, n_cell_dofs>;
    using CellTangent                         = std::array<std::array<double, n_cell_dofs>, n_cell_dofs>;

    /// `mesh` holds the reference configuration (head frame) and must outlive this.
    ElasticTail(const SimplexMesh<dim> &mesh, std::unique_ptr<HyperelasticLaw<dim>> law);

    /// Elastic energy (J, per metre of depth in 2D) of a displacement.
    double energy(const NodalField<dim> &displacement) const;

    /// Internal force (N or N/m) of one cell, entry a * dim + i, and its derivative by the displacement.
    void cell_force(unsigned int cell, const NodalField<dim> &displacement, CellForce &force) const;
    void cell_force_and_tangent(unsigned int cell, const NodalField<dim> &displacement, CellForce &force,
                                CellTangent &tangent) const;

    /// int N_a dX (m^dim): times a body force, the nodal load.
    const std::vector<double> &volume_of_node() const { return volume_of_node_; }
    /// int dN_a/dX_0 dX: times magnetization and field, the dead load of a tail magnetised along its axis.
    const std::vector<double> &axial_gradient_of_node() const { return axial_gradient_of_node_; }
    double                     volume() const { return volume_; }

    /// int N_a N_b over one cell.
    double cell_mass(const unsigned int cell, const unsigned int a, const unsigned int b) const
    {
      return cell_mass_[cell][a][b];
    }

    /// int f^2 dX of a nodal field, for norms.
    double norm_square(const NodalField<dim> &field) const;

    /// Whether the motion turns material inside out somewhere: det F <= 0 at a quadrature point.
    bool is_inverted(const NodalField<dim> &displacement) const;

    const SimplexMesh<dim> &mesh() const { return mesh_; }

  private:
    struct Point
    {
      double                                                weight;
      std::array<dealii::Tensor<1, dim>, n_cell_nodes<dim>> gradient;
      std::array<double, n_cell_nodes<dim>>                 value;
    };
    dealii::Tensor<2, dim> deformation_gradient(const Point &point, const CellNodes<dim> &nodes,
                                                const NodalField<dim> &displacement) const;

    const SimplexMesh<dim>               &mesh_;
    std::unique_ptr<HyperelasticLaw<dim>> law_;
    std::vector<std::vector<Point>>       points_; ///< of each cell
    using CellMass = std::array<std::array<double, n_cell_nodes<dim>>, n_cell_nodes<dim>>;
    std::vector<CellMass> cell_mass_;
    std::vector<double>   volume_of_node_, axial_gradient_of_node_;
    double                volume_ = 0.;
  };
} // namespace swimtwin
