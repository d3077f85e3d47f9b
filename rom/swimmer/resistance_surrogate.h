// The resistance of the swimmer against its shape, and its derivatives.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/polynomial_family.h>
#include <rom/swimmer/state_vectors.h>

#include <vector>

namespace swimtwin
{
  /// C of R = L_0 C C^T L_0^T (unit viscosity) at one shape and angle, and what evaluating it needs. Make it with
  /// ResistanceSurrogate::make_factor; it belongs to one thread.
  struct ResistanceFactor
  {
    VelocityMatrix              factor;             ///< C, lower triangular
    std::vector<VelocityMatrix> factor_derivatives; ///< by the saturated coordinates
    Eigen::MatrixXd             coordinate_slopes;  ///< of the saturated coordinates by (q_1 .. q_r, angle, height)

    Eigen::VectorXd coordinates; ///< saturated
    Eigen::VectorXd monomials, polynomials;
  };

  /// Under the mirror y -> -y: of the variables z, the modes' own and -1 for angle and height, and of the velocities
  /// (U_x, U_y, omega, dq/dt).
  Eigen::VectorXi parity_of_variables(const ReducedResistance &resistance, const Eigen::VectorXi &mode_parity);
  Eigen::VectorXi parity_of_velocities(const Eigen::VectorXi &mode_parity);

  class ResistanceSurrogate
  {
  public:
    /// `parity` of the modes. Where the coefficients keep the mirror symmetry, only half of them are ever touched.
    ResistanceSurrogate(const ReducedResistance &resistance, const Eigen::VectorXi &parity);

    int n_velocities() const { return static_cast<int>(factor_at_rest_.rows()); }
    /// r, one more if it depends on the angle, and one more if it depends on the height.
    int  n_coordinates() const { return monomials_.n_coordinates(); }
    bool depends_on_angle() const { return depends_on_angle_; }
    bool depends_on_height() const { return depends_on_height_; }

    ResistanceFactor make_factor() const;
    /// Only `factor`. Height of the head's centre, from where it was at rest.
    void evaluate(const ShapeVector &q, double angle_rad, double height_m, ResistanceFactor &result) const;
    /// Derivatives too.
    void differentiate(const ShapeVector &q, double angle_rad, double height_m, ResistanceFactor &result) const;
    /// By (q, angle, height) of the variables' rate, at given rates of these.
    Eigen::MatrixXd variable_rate_slopes(const ShapeVector &q, double angle_rad, double height_m,
                                         const ShapeVector &q_rate, double angle_rate, double height_rate) const;
    /// Only `coordinate_slopes`.
    void set_coordinate_slopes(const ShapeVector &q, double angle_rad, double height_m, ResistanceFactor &result) const;

    const VelocityMatrix &factor_at_rest() const { return factor_at_rest_; }
    /// R itself (Pa s per Pa s of viscosity, ...), n x n.
    VelocityMatrix resistance(const ShapeVector &q, double angle_rad, double height_m) const;
    /// The variables z, pulled back to the trained region; without a height at the usual one.
    Eigen::VectorXd variables(const ShapeVector &q, double angle_rad, double height_m) const;
    Eigen::VectorXd variables(const ShapeVector &q, double angle_rad) const;
    /// The same at the usual height.
    VelocityMatrix resistance(const ShapeVector &q, double angle_rad) const;

    /// |z_q|, at most 1 where the model was trained, and |angle| / angle_scale (0 if R does not depend on it).
    double shape_radius(const ShapeVector &q) const;
    double angle_radius(double angle_rad) const;
    /// |height above the usual one| / height_scale (0 if R does not depend on it).
    double height_radius(const ShapeVector &q, double angle_rad, double height_m) const;

  private:
    double usual_height_m(const ShapeVector &q, double angle_rad) const;
    void   set_coordinates(const ShapeVector &q, double angle_rad, double height_m, ResistanceFactor &result) const;
    void   set_factor(ResistanceFactor &result) const;
    void   set_factor_derivatives(ResistanceFactor &result) const;

    VelocityMatrix   factor_at_rest_;
    ShapeVector      coordinate_scale_m_;
    bool             depends_on_angle_  = false;
    double           angle_scale_rad_   = 1.;
    bool             depends_on_height_ = false;
    double           height_scale_m_ = 1., usual_by_sine_m_ = 0.;
    ShapeVector      usual_by_coordinate_;
    MonomialTable    monomials_;
    PolynomialFamily polynomials_; ///< of the entries of C, row by row; logarithms of those on its diagonal
  };
} // namespace swimtwin
