// What coils can play: bounds on a periodic field that hold at every instant.
#pragma once

#include <control/field/fourier_field.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Infinite where there is no bound.
  struct FieldLimits
  {
    static constexpr double none = std::numeric_limits<double>::infinity();

    double                magnitude_T   = none;
    std::array<double, 2> component_T   = {none, none};
    double                slew_rate_T_s = none; ///< of the magnitude of dB/dt
    /// Currents are this times (bx, by): n_coils x 2, A/T.
    Eigen::Matrix<double, Eigen::Dynamic, 2> current_per_field_A_T = {};
    double                                   current_A             = none; ///< of each coil
    /// Components and currents are those of the field turned by this: a plan is made for one heading and played in
    /// another.
    double turn_rad = 0.;
  };

  /// Bounds on a field, each in the form value <= 0, with slopes by the coefficients and by the frequency (last).
  struct LimitValues
  {
    Eigen::VectorXd values;
    Eigen::MatrixXd slopes; ///< n x (n_coefficients + 1)
  };

  /// A bound on s(phase) for all phases is one value per arc of the period: the largest s in it, found by Brent's
  /// method. Arcs are so short that s, a trigonometric polynomial, turns at most a few times in all of them together;
  /// the largest value of all arcs is then the largest of all phases, and its slope is that at its place (Danskin).
  class LimitedField
  {
  public:
    LimitedField(const FourierField &field, const FieldLimits &limits);

    int                             size() const { return static_cast<int>(names_.size()); }
    const std::vector<std::string> &names() const { return names_; } ///< "|B| <= 0.00707 T near phase 0.25"
    LimitValues                     evaluate(const Eigen::VectorXd &coefficients, double frequency_Hz) const;
    /// The largest value at n equally spaced phases.
    double largest_of(int n, const Eigen::VectorXd &coefficients, double frequency_Hz) const;

  private:
    /// s = |A v|^2 / bound^2 - 1, v the field or its rate; A is a row, or the identity.
    struct Bound
    {
      std::string     name;
      Eigen::MatrixXd matrix;
      double          bound   = 0.;
      bool            of_rate = false;
    };

    Eigen::VectorXd limited(const Bound &bound, double phase, const Eigen::VectorXd &coefficients,
                            double frequency_Hz) const;
    double value(const Bound &bound, double phase, const Eigen::VectorXd &coefficients, double frequency_Hz) const;
    Eigen::RowVectorXd slopes(const Bound &bound, double phase, const Eigen::VectorXd &coefficients,
                              double frequency_Hz) const;
    /// Phase of the largest value in an arc.
    double peak(const Bound &bound, int arc, const Eigen::VectorXd &coefficients, double frequency_Hz) const;

    FourierField             field_;
    int                      n_arcs_ = 0;
    std::vector<Bound>       bounds_;
    std::vector<std::string> names_;
  };
} // namespace swimtwin
