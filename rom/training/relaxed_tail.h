// The tail of least elastic energy at given bending coordinates: all that is not a coordinate relaxes.
#pragma once

#include <rom/training/bending_coordinates.h>

#include <Eigen/SparseCholesky>

#include <vector>

namespace swimtwin
{
  struct RelaxedShape
  {
    Eigen::VectorXd q;              ///< m
    Eigen::VectorXd displacement;   ///< m, at the tail's nodes, interleaved
    double          energy_m2 = 0.; ///< per unit depth and Young's modulus
    Eigen::VectorXd slope_m;        ///< its derivative by q: the constraints' multipliers
  };

  class RelaxedTail
  {
  public:
    /// Both must outlive this. Of any law.
    RelaxedTail(const Swimmer<2> &swimmer, const BendingCoordinates &coordinates);

    /// Shapes at q / n, 2 q / n .. q: each by Newton's method from the ones before. They end where it finds none, or
    /// where an element turns inside out.
    std::vector<RelaxedShape> on_the_way_to(const Eigen::VectorXd &q, int n);

  private:
    using SparseMatrix = Eigen::SparseMatrix<double>;
    struct Assembly
    {
      Eigen::VectorXd force;       ///< internal, over Young's modulus
      Eigen::MatrixXd constraints; ///< derivative of q, 2 n_nodes x r
      Eigen::VectorXd q;
      SparseMatrix    tangent; ///< of force less multipliers times constraints
    };
    Assembly assemble(const Eigen::VectorXd &displacement, const Eigen::VectorXd &multipliers) const;
    bool     relax(const Eigen::VectorXd &q, RelaxedShape &shape);

    const Swimmer<2>                   &swimmer_;
    const BendingCoordinates           &coordinates_;
    Eigen::SimplicialLDLT<SparseMatrix> solver_;
    bool                                is_analysed_ = false;
  };
} // namespace swimtwin
