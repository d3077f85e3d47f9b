// The bend of a tail as coordinates: how its material turns, in a few modes along the axis.
#pragma once

#include <fom/body/swimmer.h>

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace swimtwin
{
  /// q_i = L <a_i, phi>: phi(X) is the angle by which the tail's material turns (of the rotation in F, atan2(F_21 -
  /// F_12, F_11 + F_22)), <,> the mean over the tail, L its length and a_i polynomials along the axis, orthonormal in
  /// that mean. All are odd under the mirror. q (m) is L times an angle, so that lengths and coordinates have one
  /// scale.
  class BendingCoordinates
  {
  public:
    explicit BendingCoordinates(const Swimmer<2> &swimmer);

    /// The modes of these displacements (one per column), largest first: proper orthogonal decomposition of phi.
    /// Without any, polynomials by degree.
    void choose_modes(const Eigen::MatrixXd &displacements, int n);

    int    n_coordinates() const { return static_cast<int>(modes_.cols()); }
    double length_m() const { return length_m_; }
    /// Root mean square angle that each further mode adds (rad), of all that were seen.
    const Eigen::VectorXd &singular_values() const { return singular_values_; }

    /// One column per displacement.
    Eigen::MatrixXd of(const Eigen::MatrixXd &displacements) const;

    /// The rotation's derivatives at one point of the tail, by the displacements of six nodes.
    using NodeDerivative = Eigen::Matrix<double, 12, 1>;
    struct Point
    {
      std::array<unsigned int, 6> nodes;
      NodeDerivative              trace, spin;               ///< of F_11 + F_22 and F_21 - F_12
      double                      axial_m = 0., weight = 0.; ///< weights sum to one
    };
    const std::vector<Point> &points() const { return points_; }
    /// L a_i weight at a point: q is the sum of these times phi.
    Eigen::VectorXd share(std::size_t point) const
    {
      return length_m_ * points_[point].weight * modes_.row(point).transpose();
    }

    /// Angles at all points, continuous along the axis.
    Eigen::VectorXd rotations(const Eigen::VectorXd &displacement) const;

  private:
    Eigen::MatrixXd axial_polynomials() const; ///< at the points, orthonormal in the mean

    std::vector<Point>       points_;
    std::vector<std::size_t> along_axis_; ///< points from the root to the tip
    double                   length_m_ = 0., root_m_ = 0.;
    Eigen::MatrixXd          modes_; ///< points x r
    Eigen::VectorXd          singular_values_;
  };
} // namespace swimtwin
