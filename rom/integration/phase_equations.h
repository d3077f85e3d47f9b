// The equations of motion of one run in phase, with their derivatives by state and parameters.
#pragma once

#include <rom/integration/swimmer_run.h>
#include <rom/swimmer/reduced_swimmer.h>

#include <vector>

namespace swimtwin
{
  /// d state / d phase = rate(state, B(phase)) / frequency. Sensitivities are per relative change of a parameter: times
  /// `scale`, they are of the state's own size. Belongs to one thread.
  class PhaseEquations
  {
  public:
    using Vector = Eigen::Ref<Eigen::VectorXd>;
    using State  = Eigen::Ref<const Eigen::VectorXd>;

    /// Throws InputError for a parameter that the swimmer does not have.
    PhaseEquations(const ReducedSwimmer &swimmer, std::vector<Parameter> parameters);

    /// Throws InputError for values that are not possible, and for a field that lacks a parameter asked for.
    void start(const RunRequest &request);

    const ReducedSwimmer &swimmer() const { return swimmer_; }
    int                   n_parameters() const { return static_cast<int>(parameters_.size()); }
    double                scale(int parameter) const;
    void                  set_initial_sensitivity(int parameter, Vector sensitivity) const;

    void rate(double phase, const State &state, Vector rate);
    void jacobian(double phase, const State &state, Eigen::Ref<Eigen::MatrixXd> jacobian);
    void sensitivity_rate(double phase, const State &state, int parameter, const State &sensitivity, Vector rate);
    /// Rate and its derivatives by state, field and parameters, per second; valid until the next call.
    const RateDerivatives &derivatives(double phase, const State &state);
    /// Work of the field and dissipation per phase (J/m).
    void power(double phase, const State &state, Vector power);

    /// Everything about the present instant: rate, powers, field.
    const SwimmerMotion &motion(double phase, const State &state);
    Eigen::Vector2d      field_T(const double phase) const { return drive_.field->value_T(phase, drive_.parameters); }
    const Drive         &drive() const { return drive_; }
    double               elastic_energy_J_m(const State &state) const;
    double               kinetic_energy_J_m(const State &state) const;
    /// Energy (J/m) that the field can give or take: moment times field, the scale of all work.
    double work_scale_J_m() const;

    long n_rate_evaluations = 0, n_jacobians = 0;

  private:
    void differentiate(double phase, const State &state);

    const ReducedSwimmer  &swimmer_;
    std::vector<Parameter> parameters_;
    SwimmerParameters      values_;
    Drive                  drive_;
    SwimmerMotion          motion_;
    RateDerivatives        derivatives_;

    double          differentiated_phase_ = 0.; ///< where derivatives_ are
    Eigen::VectorXd differentiated_state_;
    Eigen::MatrixXd field_slopes_; ///< of the rate by the field's parameters, there
  };
} // namespace swimtwin
