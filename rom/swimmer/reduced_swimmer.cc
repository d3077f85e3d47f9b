#include <datasets/system/error.h>
#include <rom/swimmer/head_frame.h>
#include <rom/swimmer/lower_triangular.h>
#include <rom/swimmer/reduced_swimmer.h>

#include <fmt/format.h>

#include <cmath>

// Letters as in docs/equations.md, section 14: q shape, b field in the head's frame, m moment, f generalised force,
// xi generalised velocity, phi gradient of the area, p its multiplier.

namespace swimtwin
{
  namespace
  {
    const ReducedModel &checked(const ReducedModel &model)
    {
      if (model.n_modes() > max_modes)
        throw InputError(
            fmt::format("the reduced model has {} modes; this program moves at most {}: use fewer of them.",
                        model.n_modes(), max_modes));
      return model;
    }

    double largest_distance(const Eigen::MatrixXd &nodes)
    {
      return nodes.rowwise().norm().maxCoeff();
    }

    /// L^T xi, L = L_0 C: its square is the dissipation over the viscosity.
    VelocityVector pulled_back(const VelocityMatrix &factor_at_rest, const SwimmerMotion &motion)
    {
      return transposed_lower_times(motion.resistance.factor, transposed_lower_times(factor_at_rest, motion.velocity));
    }
  } // namespace

  ReducedSwimmer::ReducedSwimmer(const ReducedModel &model, const InertialDensities &densities)
      : r_(checked(model).n_modes()), length_m_(largest_distance(model.tail.nodes_m)), tip_(model.tail),
        amplitudes_(model.tail), energy_(model.elasticity, model.tail),
        resistance_(model.resistance, model.tail.coordinate_parity()), magnet_(model.magnet), area_(model.area),
        has_inertia_(densities.any())
  {
    if (!has_inertia_)
      return;
    if (!model.inertia.is_given())
      throw InputError("the reduced model was trained without inertia, which this run carries: train it again, or "
                       "leave inertia out (fluid.inertia = \"none\").");
    if (densities.fluid_kg_m3 <= 0. && densities.tail_kg_m3 <= 0.)
      throw InputError("a reduced swimmer cannot carry the inertia of its head alone, which leaves its shape without "
                       "mass: name \"tail\" in [fluid] inertia, too, or \"full\".");
    if (area_.is_kept)
      throw InputError("a reduced model whose area is kept by a condition of its own cannot carry inertia: train it "
                       "with --basis bending, or leave inertia out (fluid.inertia = \"none\").");
    const Eigen::VectorXi parity = model.tail.coordinate_parity();
    inertia_ = InertiaSurrogate(model.inertia, densities, parity_of_variables(model.resistance, parity),
                                parity_of_velocities(parity));
  }

  VelocityMatrix ReducedSwimmer::mass(const ShapeVector &q, const double angle_rad) const
  {
    return inertia_.mass(resistance_.variables(q, angle_rad));
  }

  double ReducedSwimmer::kinetic_energy_J_m(const SwimmerState &state) const
  {
    if (!has_inertia_)
      return 0.;
    const VelocityVector velocity = state.tail(n_velocities());
    return .5 * velocity.dot(inertia_.mass(resistance_.variables(shape_of(state), state[2], state[1])) * velocity);
  }

  double ReducedSwimmer::area_change(const ShapeVector &q) const
  {
    const AmplitudeVector p = amplitudes_.value(q);
    return area_.linear_m.dot(p) + p.dot(area_.quadratic * p);
  }

  ShapeVector ReducedSwimmer::area_gradient(const ShapeVector &q) const
  {
    return amplitudes_.pull_back(q, area_gradient_by_amplitudes(q));
  }

  AmplitudeVector ReducedSwimmer::area_gradient_by_amplitudes(const ShapeVector &q) const
  {
    return area_.linear_m + 2. * area_.quadratic * amplitudes_.value(q);
  }

  ShapeMatrix ReducedSwimmer::area_hessian(const ShapeVector &q) const
  {
    const AmplitudeMatrix J = amplitudes_.slopes(q);
    ShapeMatrix           H = amplitudes_.curvature(q, area_gradient_by_amplitudes(q));
    H += 2. * J.transpose() * area_.quadratic * J;
    return H;
  }

  VelocityVector ReducedSwimmer::area_direction(const ShapeVector &q) const
  {
    VelocityVector phi = VelocityVector::Zero(n_velocities());
    phi.tail(r_)       = area_gradient(q);
    return phi;
  }

  Eigen::Vector2d ReducedSwimmer::moment(const ShapeVector &q, const SwimmerParameters &parameters) const
  {
    const Eigen::Vector2d head = parameters.magnetization_A_m * magnet_.head_area_m2 * Eigen::Vector2d::UnitX();
    if (parameters.tail_magnetization_A_m == 0.)
      return head;
    return head + parameters.tail_magnetization_A_m * tail_area(q);
  }

  Eigen::Vector2d ReducedSwimmer::tail_area(const ShapeVector &q) const
  {
    return magnet_.tail_area_m2 + magnet_.tail_area_of_mode_m * amplitudes_.value(q);
  }

  Eigen::Matrix2Xd ReducedSwimmer::tail_area_slopes(const ShapeVector &q) const
  {
    return magnet_.tail_area_of_mode_m * amplitudes_.slopes(q);
  }

  Eigen::Matrix2Xd ReducedSwimmer::moment_slopes(const ShapeVector &q, const SwimmerParameters &parameters) const
  {
    return parameters.tail_magnetization_A_m * tail_area_slopes(q);
  }

  SwimmerMotion ReducedSwimmer::make_motion() const
  {
    SwimmerMotion motion;
    motion.velocity   = VelocityVector::Zero(n_velocities());
    motion.rate       = VelocityVector::Zero(n_states());
    motion.resistance = resistance_.make_factor();
    if (has_inertia_)
      motion.inertia = inertia_.make();
    return motion;
  }

  VelocityVector ReducedSwimmer::magnetic_force(const ShapeVector &q, const Eigen::Vector2d &moment,
                                                const Eigen::Vector2d &head_field,
                                                const double           tail_magnetization) const
  {
    VelocityVector f = VelocityVector::Zero(n_velocities());
    f[2]             = cross(moment, head_field);
    if (tail_magnetization != 0.)
      f.tail(r_) = tail_magnetization * (tail_area_slopes(q).transpose() * head_field);
    return f;
  }

  VelocityVector ReducedSwimmer::force(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                       const SwimmerParameters &parameters, const ShapeVector &energy_gradient) const
  {
    const ShapeVector q = shape_of(state);
    VelocityVector    f =
        magnetic_force(q, moment(q, parameters), in_head_frame(state[2], field_T), parameters.tail_magnetization_A_m);
    f.tail(r_) -= parameters.young_modulus_Pa * energy_gradient;
    return f;
  }

  void ReducedSwimmer::solve(const ResistanceFactor &resistance, Eigen::MatrixXd &columns) const
  {
    const auto L0 = resistance_.factor_at_rest().triangularView<Eigen::Lower>();
    const auto C  = resistance.factor.triangularView<Eigen::Lower>();
    L0.solveInPlace(columns);
    C.solveInPlace(columns);
    C.transpose().solveInPlace(columns);
    L0.transpose().solveInPlace(columns);
  }

  void ReducedSwimmer::solve(const ResistanceFactor &resistance, VelocityVector &column) const
  {
    const auto L0 = resistance_.factor_at_rest().triangularView<Eigen::Lower>();
    const auto C  = resistance.factor.triangularView<Eigen::Lower>();
    L0.solveInPlace(column);
    C.solveInPlace(column);
    C.transpose().solveInPlace(column);
    L0.transpose().solveInPlace(column);
  }

  void ReducedSwimmer::set_velocity(const SwimmerState &state, const VelocityVector &force, const double viscosity,
                                    SwimmerMotion &motion, double &pressure) const
  {
    motion.velocity = force / viscosity;
    solve(motion.resistance, motion.velocity);
    pressure = 0.;
    if (area_.is_kept)
    {
      const VelocityVector phi         = area_direction(shape_of(state));
      VelocityVector       by_pressure = phi;
      solve(motion.resistance, by_pressure);
      const double multiple = phi.dot(motion.velocity) / phi.dot(by_pressure);
      motion.velocity -= multiple * by_pressure;
      pressure = viscosity * multiple;
    }
    motion.rate = motion.velocity;
    turn_to_laboratory(state[2], motion.rate);
  }

  void ReducedSwimmer::set_rate(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                const SwimmerParameters &parameters, SwimmerMotion &motion) const
  {
    double pressure = 0.;
    resistance_.evaluate(shape_of(state), state[2], state[1], motion.resistance);
    const VelocityVector f = force(state, field_T, parameters, energy_.gradient(shape_of(state)));
    if (has_inertia_)
      set_inertial_rate(state, f, parameters.viscosity_Pa_s, motion);
    else
      set_velocity(state, f, parameters.viscosity_Pa_s, motion, pressure);
  }

  VelocityVector ReducedSwimmer::drag(const SwimmerMotion &motion, const double viscosity) const
  {
    const VelocityMatrix &L0 = resistance_.factor_at_rest();
    return viscosity * lower_times(L0, lower_times(motion.resistance.factor, pulled_back(L0, motion)));
  }

  void ReducedSwimmer::move(const SwimmerState &state, const Eigen::Vector2d &field_T,
                            const SwimmerParameters &parameters, SwimmerMotion &motion) const
  {
    set_rate(state, field_T, parameters, motion);
    const ShapeVector    q = shape_of(state);
    const VelocityVector f =
        magnetic_force(q, moment(q, parameters), in_head_frame(state[2], field_T), parameters.tail_magnetization_A_m);
    motion.magnetic_power_W_m = f.dot(motion.velocity);
    motion.dissipation_W_m =
        parameters.viscosity_Pa_s * pulled_back(resistance_.factor_at_rest(), motion).squaredNorm();
    motion.elastic_power_W_m = parameters.young_modulus_Pa * energy_.gradient(q).dot(motion.velocity.tail(r_));
    if (!has_inertia_)
      return;
    const VelocityVector momentum = motion.inertia.mass * motion.velocity;
    motion.kinetic_energy_J_m     = .5 * motion.velocity.dot(momentum);
    motion.kinetic_power_W_m =
        momentum.dot(motion.rate.tail(n_velocities())) + motion.velocity.dot(motion.inertia.force);
  }

  Eigen::Vector3d ReducedSwimmer::head_velocity(const SwimmerState &state, const ShapeVector &shape_rate,
                                                const double torque_N, const double viscosity_Pa_s,
                                                ResistanceFactor &resistance) const
  {
    resistance_.evaluate(shape_of(state), state[2], state[1], resistance);
    const VelocityMatrix  L        = resistance_.factor_at_rest() * resistance.factor;
    const Eigen::Matrix3d rigid    = L.topRows<3>() * L.topRows<3>().transpose();
    const Eigen::Vector3d by_shape = L.topRows<3>() * (L.bottomRows(r_).transpose() * shape_rate);
    const Eigen::Vector3d load     = Eigen::Vector3d(0., 0., torque_N / viscosity_Pa_s) - by_shape;
    return rigid.llt().solve(load);
  }

  SwimmerState state_at_rest(const ReducedSwimmer &swimmer, const double angle_rad)
  {
    SwimmerState state = SwimmerState::Zero(swimmer.n_states());
    state[2]           = angle_rad;
    return state;
  }
} // namespace swimtwin
