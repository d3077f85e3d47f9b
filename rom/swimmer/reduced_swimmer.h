// The equations of motion of the reduced swimmer (docs/equations.md, section 14).
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/elastic_energy.h>
#include <rom/swimmer/inertia_surrogate.h>
#include <rom/swimmer/resistance_surrogate.h>
#include <rom/swimmer/swimmer_parameters.h>
#include <rom/swimmer/tail_tip.h>

namespace swimtwin
{
  /// Velocities and powers at one instant, and the memory to compute them in. Make it with
  /// ReducedSwimmer::make_motion; it belongs to one thread.
  struct SwimmerMotion
  {
    VelocityVector velocity; ///< xi = (R^T dx/dt, omega, dq/dt): m/s, rad/s, m/s
    VelocityVector rate;     ///< d state / dt, in the laboratory; with inertia dxi/dt follows, in the head's frame

    double magnetic_power_W_m = 0., dissipation_W_m = 0., elastic_power_W_m = 0.;
    double kinetic_energy_J_m = 0., kinetic_power_W_m = 0.; ///< its rate; zero without inertia

    ResistanceFactor resistance;
    InertiaValues    inertia;
  };

  /// Derivatives of SwimmerMotion::rate, and the memory to compute them in.
  struct RateDerivatives
  {
    VelocityVector  rate;     ///< itself
    Eigen::MatrixXd by_state; ///< square, a zero column for x
    Eigen::MatrixXd by_field; ///< two columns, per T in the laboratory
    VelocityVector  by_young_modulus, by_viscosity, by_magnetization, by_tail_magnetization;

    Eigen::MatrixXd columns; ///< generalised forces, then velocities, of all derivatives together
  };

  class ReducedSwimmer
  {
  public:
    /// With the inertia of these densities, whose velocities then belong to the state. Throws InputError for more than
    /// `max_modes` modes, and for inertia that the model does not have.
    explicit ReducedSwimmer(const ReducedModel &model, const InertialDensities &densities = {});

    int    n_modes() const { return r_; }
    int    n_velocities() const { return r_ + 3; }
    int    n_states() const { return has_inertia_ ? 2 * n_velocities() : n_velocities(); }
    bool   has_inertia() const { return has_inertia_; }
    double length_m() const { return length_m_; } ///< largest distance of the tail from the head's centre, at rest

    ShapeVector shape_of(const SwimmerState &state) const { return state.segment(3, r_); }

    const TailTip             &tip() const { return tip_; }
    const ElasticEnergy       &energy() const { return energy_; }
    const ResistanceSurrogate &resistance() const { return resistance_; }
    bool                       keeps_area() const { return area_.is_kept; }
    /// M of the inertia (kg per unit depth, ...), at the usual height.
    VelocityMatrix mass(const ShapeVector &q, double angle_rad) const;
    /// Of a state; zero without inertia.
    double kinetic_energy_J_m(const SwimmerState &state) const;
    /// Change of the tail's area (m^2), kept at zero in a closed domain, and its gradient by q (m).
    double      area_change(const ShapeVector &q) const;
    ShapeVector area_gradient(const ShapeVector &q) const;

    /// Moment per unit depth (A) in the head's frame.
    Eigen::Vector2d moment(const ShapeVector &q, const SwimmerParameters &parameters) const;
    /// Its derivative by the shape (A/m), 2 x r.
    Eigen::Matrix2Xd moment_slopes(const ShapeVector &q, const SwimmerParameters &parameters) const;

    SwimmerMotion   make_motion() const;
    RateDerivatives make_derivatives() const;

    /// Velocity, rate and powers in a field (T, in the laboratory).
    void move(const SwimmerState &state, const Eigen::Vector2d &field_T, const SwimmerParameters &parameters,
              SwimmerMotion &motion) const;
    /// The same without the powers.
    void set_rate(const SwimmerState &state, const Eigen::Vector2d &field_T, const SwimmerParameters &parameters,
                  SwimmerMotion &motion) const;
    /// Rate and its derivatives.
    void differentiate(const SwimmerState &state, const Eigen::Vector2d &field_T, const SwimmerParameters &parameters,
                       SwimmerMotion &motion, RateDerivatives &derivatives) const;
    /// Velocity of the head, force-free and under the field's torque, when the shape changes at the rate dq/dt:
    /// (R^T dx/dt, omega).
    Eigen::Vector3d head_velocity(const SwimmerState &state, const ShapeVector &shape_rate, double torque_N,
                                  double viscosity_Pa_s, ResistanceFactor &resistance) const;

  private:
    /// Generalised magnetic force (0, 0, torque, forces on the modes) of a field in the head's frame.
    VelocityVector magnetic_force(const ShapeVector &q, const Eigen::Vector2d &moment,
                                  const Eigen::Vector2d &head_field, double tail_magnetization) const;
    /// Integral of the tail's deformation gradient along its axis (m^2), and its derivative by q.
    Eigen::Vector2d  tail_area(const ShapeVector &q) const;
    Eigen::Matrix2Xd tail_area_slopes(const ShapeVector &q) const;
    AmplitudeVector  area_gradient_by_amplitudes(const ShapeVector &q) const;
    ShapeMatrix      area_hessian(const ShapeVector &q) const;
    VelocityVector force(const SwimmerState &state, const Eigen::Vector2d &field_T, const SwimmerParameters &parameters,
                         const ShapeVector &energy_gradient) const;
    /// (0, 0, 0, area gradient).
    VelocityVector area_direction(const ShapeVector &q) const;
    /// Columns of forces become columns of velocities at unit viscosity, free of the area's constraint.
    void solve(const ResistanceFactor &resistance, Eigen::MatrixXd &columns) const;
    void solve(const ResistanceFactor &resistance, VelocityVector &column) const;
    void set_velocity(const SwimmerState &state, const VelocityVector &force, double viscosity, SwimmerMotion &motion,
                      double &pressure) const;
    void set_force_derivatives(const SwimmerState &state, const Eigen::Vector2d &field_T,
                               const SwimmerParameters &parameters, const EnergySlopes &energy,
                               Eigen::MatrixXd &columns) const;
    void add_resistance_derivatives(const SwimmerMotion &motion, double viscosity, Eigen::MatrixXd &columns) const;
    void constrain_derivatives(const SwimmerState &state, const SwimmerMotion &motion, Eigen::MatrixXd &columns) const;
    /// mu R xi of motion.velocity.
    VelocityVector drag(const SwimmerMotion &motion, double viscosity) const;

    // With inertia:
    /// How the variables of the surrogates change: with (q, angle, height) by the columns of coordinate_slopes.
    Eigen::VectorXd variable_rate(const SwimmerState &state, const ResistanceFactor &at) const;
    /// dz/dt by the velocities.
    Eigen::MatrixXd variable_rate_by_velocity(const SwimmerState &state, const ResistanceFactor &at) const;
    void            set_inertial_rate(const SwimmerState &state, const VelocityVector &force, double viscosity,
                                      SwimmerMotion &motion) const;
    void            add_inertia_derivatives(const SwimmerState &state, const SwimmerMotion &motion,
                                            Eigen::MatrixXd &columns) const;
    void            differentiate_inertial(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                           const SwimmerParameters &parameters, SwimmerMotion &motion,
                                           RateDerivatives &derivatives) const;

    int                 r_        = 0;
    double              length_m_ = 0.;
    TailTip             tip_;
    ShapeAmplitudes     amplitudes_;
    ElasticEnergy       energy_;
    ResistanceSurrogate resistance_;
    ReducedMagnet       magnet_;
    ReducedArea         area_;
    bool                has_inertia_ = false;
    InertiaSurrogate    inertia_;
  };

  /// The swimmer at rest: straight, its head's centre at the origin, velocities zero.
  SwimmerState state_at_rest(const ReducedSwimmer &swimmer, double angle_rad = 0.);
} // namespace swimtwin
