// The bend of a tail as coordinates: how its material turns, in a few modes along the axis.
#pragma once

#include <fom/body/swimmer.h>

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace swimtwin
{
  /// q_i = L <a_i, phi>: phi(X) is the angle by which the tail's material turns in the plane of x and y (of the
  /// rotation in F, atan2(F_21 - F_12, F_11 + F_22)), <,> the mean over the tail, L its length and a_i polynomials
  /// along the axis, orthonormal in that mean. All are odd under the mirror. q (m) is L times an angle, so that lengths
  /// and coordinates have one scale.
  class BendingCoordinates
  {
  public:
    template <int dim>
    explicit BendingCoordinates(const Swimmer<dim> &swimmer);

    /// The modes of these displacements (one per column), largest first: proper orthogonal decomposition of phi.
    /// Without any, polynomials by degree.
    void choose_modes(const Eigen::MatrixXd &displacements, int n);

    int    n_coordinates() const { return static_cast<int>(modes_.cols()); }
    double length_m() const { return length_m_; }
    /// Root mean square angle that each further mode adds (rad), of all that were seen.
    const Eigen::VectorXd &singular_values() const { return singular_values_; }

    /// One column per displacement.
    Eigen::MatrixXd of(const Eigen::MatrixXd &displacements) const;

    /// Of a cell's nodes what lies in the plane: x and y of the first, of the second, ...
    using CellVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * n_cell_nodes<3>, 1>;
    struct Point
    {
      CellVector trace, spin;               ///< derivatives of F_11 + F_22 and F_21 - F_12
      double     axial_m = 0., weight = 0.; ///< weights sum to one
    };
    std::size_t n_points_of_cell() const { return n_points_of_cell_; }
    /// Those of a cell of the tail's mesh, in its order.
    std::span<const Point> points_of(const std::size_t cell) const
    {
      return {points_.data() + cell * n_points_of_cell_, n_points_of_cell_};
    }
    CellVector in_plane(std::size_t cell, const Eigen::VectorXd &displacement) const;
    /// L a_i weight at the k-th point of a cell: q is the sum of these times phi.
    Eigen::VectorXd share(const std::size_t cell, const std::size_t k) const
    {
      const std::size_t p = cell * n_points_of_cell_ + k;
      return length_m_ * points_[p].weight * modes_.row(static_cast<Eigen::Index>(p)).transpose();
    }

    /// Angles at all points, cell by cell, continuous along the axis.
    Eigen::VectorXd rotations(const Eigen::VectorXd &displacement) const;

  private:
    Eigen::MatrixXd axial_polynomials() const; ///< at the points, orthonormal in the mean

    int                                    dimension_ = 0;
    std::vector<std::vector<unsigned int>> nodes_; ///< of each cell
    std::vector<Point>                     points_;
    std::size_t                            n_points_of_cell_ = 0;
    std::vector<std::size_t>               along_axis_; ///< points from the root to the tip
    double                                 length_m_ = 0., root_m_ = 0.;
    Eigen::MatrixXd                        modes_; ///< points x r
    Eigen::VectorXd                        singular_values_;
  };
} // namespace swimtwin
