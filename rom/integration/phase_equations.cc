#include <datasets/system/error.h>
#include <rom/integration/phase_equations.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double field_scale_T = 1e-3; // where all of the field's parameters are zero

    void require(const bool condition, const char *name, const double value, const char *rule)
    {
      if (!condition)
        throw InputError(fmt::format("{} = {:.6g} of the reduced swimmer must be {}.", name, value, rule));
    }

    void check_values(const RunRequest &request)
    {
      const auto &[E, mu, M_head, M_tail] = request.parameters;
      require(std::isfinite(E) && E > 0., "young_modulus_Pa", E, "positive");
      require(std::isfinite(mu) && mu > 0., "viscosity_Pa_s", mu, "positive");
      require(std::isfinite(M_head), "magnetization_A_m", M_head, "finite");
      require(std::isfinite(M_tail), "tail magnetization_A_m", M_tail, "finite");
      const double f = request.drive.frequency_Hz;
      require(std::isfinite(f) && f > 0., "frequency_Hz", f, "positive");
      for (const double value : request.drive.parameters)
        require(std::isfinite(value), "a parameter of the field", value, "finite");
      for (const double value : request.initial_state)
        require(std::isfinite(value), "the initial state", value, "finite");
    }
  } // namespace

  PhaseEquations::PhaseEquations(const ReducedSwimmer &swimmer, std::vector<Parameter> parameters)
      : swimmer_(swimmer), parameters_(std::move(parameters)), motion_(swimmer.make_motion()),
        derivatives_(swimmer.make_derivatives())
  {
    for (const auto &[quantity, index] : parameters_)
      if (quantity == Quantity::initial_shape && (index < 0 || index >= swimmer.n_modes()))
        throw InputError(fmt::format("a derivative by the initial coordinate of mode {} was asked of a swimmer with {} "
                                     "modes.",
                                     index, swimmer.n_modes()));
      else if (quantity == Quantity::initial_velocity &&
               !(swimmer.has_inertia() && index >= 0 && index < swimmer.n_velocities()))
        throw InputError(fmt::format("a derivative by initial velocity {} was asked of a swimmer with {} velocities in "
                                     "its state.",
                                     index, swimmer.has_inertia() ? swimmer.n_velocities() : 0));
  }

  void PhaseEquations::start(const RunRequest &request)
  {
    check_values(request);
    values_ = request.parameters;
    drive_  = request.drive;
    for (const auto &[quantity, index] : parameters_)
      if (quantity == Quantity::field && (index < 0 || index >= drive_.parameters.size()))
        throw InputError(fmt::format("a derivative by parameter {} of a field with {} parameters was asked for.", index,
                                     drive_.parameters.size()));
    differentiated_state_.resize(0);
    n_rate_evaluations = n_jacobians = 0;
  }

  double PhaseEquations::scale(const int parameter) const
  {
    const auto or_one             = [](const double value) { return value != 0. ? std::abs(value) : 1.; };
    const auto &[quantity, index] = parameters_[static_cast<std::size_t>(parameter)];
    switch (quantity)
    {
    case Quantity::young_modulus:
      return values_.young_modulus_Pa;
    case Quantity::viscosity:
      return values_.viscosity_Pa_s;
    case Quantity::magnetization:
      return or_one(values_.magnetization_A_m);
    case Quantity::tail_magnetization:
      return or_one(values_.tail_magnetization_A_m);
    case Quantity::frequency:
      return drive_.frequency_Hz;
    case Quantity::field:
      return std::max(drive_.parameters.lpNorm<Eigen::Infinity>(), field_scale_T);
    case Quantity::initial_angle:
      return 1.;
    case Quantity::initial_shape:
    case Quantity::initial_velocity:
      return swimmer_.length_m();
    }
    return 1.;
  }

  void PhaseEquations::set_initial_sensitivity(const int parameter, Vector sensitivity) const
  {
    const auto &[quantity, index] = parameters_[static_cast<std::size_t>(parameter)];
    sensitivity.setZero();
    if (quantity == Quantity::initial_angle)
      sensitivity[2] = scale(parameter);
    if (quantity == Quantity::initial_shape)
      sensitivity[3 + index] = scale(parameter);
    if (quantity == Quantity::initial_velocity)
      sensitivity[swimmer_.n_velocities() + index] = scale(parameter);
  }

  void PhaseEquations::rate(const double phase, const State &state, Vector rate)
  {
    swimmer_.set_rate(state, field_T(phase), values_, motion_);
    rate = motion_.rate / drive_.frequency_Hz;
    ++n_rate_evaluations;
  }

  void PhaseEquations::differentiate(const double phase, const State &state)
  {
    if (phase == differentiated_phase_ && differentiated_state_.size() == state.size() &&
        differentiated_state_ == state)
      return;
    swimmer_.differentiate(state, field_T(phase), values_, motion_, derivatives_);
    const bool by_field = std::any_of(parameters_.begin(), parameters_.end(),
                                      [](const Parameter &p) { return p.quantity == Quantity::field; });
    if (by_field)
      field_slopes_ = derivatives_.by_field * drive_.field->slopes(phase, drive_.parameters);
    differentiated_phase_ = phase;
    differentiated_state_ = state;
    ++n_jacobians;
  }

  const RateDerivatives &PhaseEquations::derivatives(const double phase, const State &state)
  {
    differentiate(phase, state);
    return derivatives_;
  }

  void PhaseEquations::jacobian(const double phase, const State &state, Eigen::Ref<Eigen::MatrixXd> jacobian)
  {
    differentiate(phase, state);
    jacobian = derivatives_.by_state / drive_.frequency_Hz;
  }

  void PhaseEquations::sensitivity_rate(const double phase, const State &state, const int parameter,
                                        const State &sensitivity, Vector rate)
  {
    differentiate(phase, state);
    rate.noalias()                = derivatives_.by_state * sensitivity;
    const double factor           = scale(parameter);
    const auto &[quantity, index] = parameters_[static_cast<std::size_t>(parameter)];
    switch (quantity)
    {
    case Quantity::young_modulus:
      rate += factor * derivatives_.by_young_modulus;
      break;
    case Quantity::viscosity:
      rate += factor * derivatives_.by_viscosity;
      break;
    case Quantity::magnetization:
      rate += factor * derivatives_.by_magnetization;
      break;
    case Quantity::tail_magnetization:
      rate += factor * derivatives_.by_tail_magnetization;
      break;
    case Quantity::frequency:
      rate -= factor / drive_.frequency_Hz * derivatives_.rate;
      break;
    case Quantity::field:
      rate += factor * field_slopes_.col(index);
      break;
    case Quantity::initial_angle:
    case Quantity::initial_shape:
    case Quantity::initial_velocity:
      break;
    }
    rate /= drive_.frequency_Hz;
  }

  const SwimmerMotion &PhaseEquations::motion(const double phase, const State &state)
  {
    swimmer_.move(state, field_T(phase), values_, motion_);
    ++n_rate_evaluations;
    return motion_;
  }

  void PhaseEquations::power(const double phase, const State &state, Vector power)
  {
    const SwimmerMotion &now = motion(phase, state);
    power << now.magnetic_power_W_m / drive_.frequency_Hz, now.dissipation_W_m / drive_.frequency_Hz;
  }

  double PhaseEquations::elastic_energy_J_m(const State &state) const
  {
    return values_.young_modulus_Pa * swimmer_.energy().value(state.segment(3, swimmer_.n_modes()));
  }

  double PhaseEquations::kinetic_energy_J_m(const State &state) const
  {
    return swimmer_.kinetic_energy_J_m(state);
  }

  double PhaseEquations::work_scale_J_m() const
  {
    constexpr int n_samples = 16;
    double        largest_T = 0.;
    for (int i = 0; i < n_samples; ++i)
      largest_T = std::max(largest_T, field_T((i + 0.5) / n_samples).norm());
    return swimmer_.moment(ShapeVector::Zero(swimmer_.n_modes()), values_).norm() * largest_T;
  }
} // namespace swimtwin
