// The tail of least elastic energy at given bending coordinates: all that is not a coordinate relaxes.
#pragma once

#include <rom/training/bending_coordinates.h>

#include <Eigen/SparseCholesky>

#include <array>
#include <vector>

namespace swimtwin
{
  struct RelaxedShape
  {
    Eigen::VectorXd q;              ///< m
    Eigen::VectorXd displacement;   ///< m, at the tail's nodes, interleaved
    double          energy_m2 = 0.; ///< over Young's modulus; per unit depth, in space m^3
    Eigen::VectorXd slope_m;        ///< its derivative by q: the constraints' multipliers
  };

  template <int dim>
  class RelaxedTail
  {
  public:
    /// Both must outlive this. Of any law.
    RelaxedTail(const Swimmer<dim> &swimmer, const BendingCoordinates &coordinates);

    /// Shapes at q / n, 2 q / n .. q: each by Newton's method from the ones before. They end where it finds none, or
    /// where an element turns inside out.
    std::vector<RelaxedShape> on_the_way_to(const Eigen::VectorXd &q, int n);

  private:
    static constexpr int n_cell_rows = dim * n_cell_nodes<dim>;
    using SparseMatrix               = Eigen::SparseMatrix<double>;
    using CellMatrix                 = Eigen::Matrix<double, n_cell_rows, n_cell_rows>;
    struct Assembly
    {
      Eigen::VectorXd force;       ///< internal, over Young's modulus
      Eigen::MatrixXd constraints; ///< derivative of q, dim n_nodes x r
      Eigen::VectorXd q;
    };
    /// In space the half at z >= 0 tells the other one.
    void choose_half();
    bool is_fixed(const unsigned int node, const int component) const { return is_fixed_[dim * node + component]; }
    /// Of the tangent, that of the force less multipliers times constraints, with unit rows where nothing is solved
    /// for.
    void     lay_out();
    void     add_to_tangent(std::size_t k, const CellMatrix &matrix);
    Assembly assemble(const Eigen::VectorXd &displacement, const Eigen::VectorXd &multipliers);
    void     reflect(Eigen::VectorXd &displacement) const;
    bool     relax(const Eigen::VectorXd &q, RelaxedShape &shape);

    const Swimmer<dim>                  &swimmer_;
    const BendingCoordinates            &coordinates_;
    std::vector<unsigned int>            cells_;       ///< that are solved for
    double                               weight_ = 1.; ///< how many each stands for
    std::vector<std::array<unsigned, 2>> images_;      ///< nodes that are solved for, and their images
    std::vector<char>                    is_fixed_;    ///< by rows: clamped, on the plane across it, or an image
    SparseMatrix                         tangent_;
    std::vector<std::ptrdiff_t>          place_; ///< among its values, of each cell's entries; none for fixed rows
    Eigen::SimplicialLDLT<SparseMatrix>  solver_;
  };
} // namespace swimtwin
