#include <twin/motion/twin_process.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int n_field_noises = 2;
    constexpr int max_halvings   = 6; // of a step that Newton's method does not find

    // Columns of the noise: the swimmer's state, the parameters, the viscosity, the field.
    Eigen::Index count_noises(const TwinLayout &layout)
    {
      return layout.n_states() + 1 + n_field_noises;
    }
  } // namespace

  TwinProcess::TwinProcess(const ReducedSwimmer &swimmer, const SwimmerParameters &nominal, const TwinLayout &layout,
                           const FieldSignal &field, const ModelNoise &noise, const double largest_step_s)
      : swimmer_(swimmer), nominal_(nominal), layout_(layout), field_(field), noise_(noise),
        largest_step_s_(largest_step_s), n_noises_(count_noises(layout)), step_(swimmer),
        motion_(swimmer.make_motion()), part_(layout.n_states(), layout.n_states()),
        product_(layout.n_states(), layout.n_states()),
        field_slopes_(Eigen::MatrixXd::Zero(layout.n_states(), n_field_noises))
  {
  }

  SwimmerParameters TwinProcess::parameters(const Eigen::VectorXd &state) const
  {
    SwimmerParameters values = nominal_;
    values.young_modulus_Pa *= std::exp(layout_.value(TwinParameter::stiffness, state));
    const double magnet = std::exp(layout_.value(TwinParameter::magnetization, state));
    values.magnetization_A_m *= magnet;
    values.tail_magnetization_A_m *= magnet;
    return values;
  }

  Eigen::Vector2d TwinProcess::background_T(const Eigen::VectorXd &state) const
  {
    return {layout_.value(TwinParameter::background_x, state), layout_.value(TwinParameter::background_y, state)};
  }

  Eigen::Vector2d TwinProcess::field_T(const double time_s, const Eigen::VectorXd &state) const
  {
    return field_.value_T(time_s) + background_T(state);
  }

  const VelocityVector &TwinProcess::rate(const double time_s, const Eigen::VectorXd &state)
  {
    swimmer_.set_rate(state.head(layout_.n_swimmer()), field_T(time_s, state), parameters(state), motion_);
    motion_.rate[0] += layout_.value(TwinParameter::flow_x, state);
    motion_.rate[1] += layout_.value(TwinParameter::flow_y, state);
    return motion_.rate;
  }

  void TwinProcess::set_transition(const double length, Eigen::MatrixXd &transition) const
  {
    const int n = layout_.n_swimmer();
    transition.setIdentity();
    transition.topLeftCorner(n, n)                                                           = step_.by_start();
    constexpr std::array<std::pair<TwinParameter, StepParameter>, n_step_parameters> columns = {
        {{TwinParameter::stiffness, log_stiffness},
         {TwinParameter::magnetization, log_magnetization},
         {TwinParameter::background_x, background_x},
         {TwinParameter::background_y, background_y}}};
    for (const auto &[parameter, column] : columns)
      if (layout_.is_estimated(parameter))
        transition.col(layout_.place(parameter)).head(n) = step_.by_parameters().col(column);
    if (layout_.is_estimated(TwinParameter::flow_x))
      transition(0, layout_.place(TwinParameter::flow_x)) = length;
    if (layout_.is_estimated(TwinParameter::flow_y))
      transition(1, layout_.place(TwinParameter::flow_y)) = length;
  }

  bool TwinProcess::go(const double from_s, const double to_s, Eigen::VectorXd &mean, Eigen::MatrixXd &transition,
                       const int depth)
  {
    const int       n      = layout_.n_swimmer();
    const double    length = to_s - from_s;
    SwimmerState    state  = mean.head(n);
    Eigen::Vector2d flow(layout_.value(TwinParameter::flow_x, mean), layout_.value(TwinParameter::flow_y, mean));
    if (step_.advance(field_, from_s, to_s, parameters(mean), background_T(mean), state))
    {
      state.head<2>() += length * flow;
      mean.head(n) = state;
      set_transition(length, part_);
      product_.noalias() = part_ * transition;
      transition.swap(product_);
      field_slopes_.topRows(n) = step_.by_parameters().middleCols<n_field_noises>(background_x);
      return mean.allFinite();
    }
    const double middle_s = 0.5 * (from_s + to_s);
    return depth < max_halvings && go(from_s, middle_s, mean, transition, depth + 1) &&
           go(middle_s, to_s, mean, transition, depth + 1);
  }

  /// What is added to the swimmer's state enters at the step's end, what parameters drift at its start.
  void TwinProcess::set_noise(const double from_s, const double length, const Eigen::MatrixXd &transition,
                              Eigen::MatrixXd &noise) const
  {
    const double root = std::sqrt(length);
    noise.setZero();
    noise(0, 0) = noise(1, 1) = root * noise_.position_m;
    noise(2, 2)               = root * noise_.angle_rad;
    for (Eigen::Index i = 0; i < noise_.shape_m.size(); ++i)
      noise(3 + i, 3 + i) = root * noise_.shape_m[i];
    if (const int n = swimmer_.n_velocities();
        swimmer_.has_inertia()) // forgotten within a step; keeps the root regular
      noise.diagonal().segment(n, n) = noise.diagonal().head(n) / largest_step_s_;
    for (int i = 0; i < n_twin_parameters; ++i)
      if (const auto p = static_cast<TwinParameter>(i); layout_.is_estimated(p))
        noise.col(layout_.place(p)) = root * layout_.parameters()[p].drift * transition.col(layout_.place(p));
    for (const TwinParameter p : {TwinParameter::stiffness, TwinParameter::magnetization})
      if (layout_.is_estimated(p))
        noise.col(layout_.n_states()) -= root * layout_.parameters().viscosity_drift * transition.col(layout_.place(p));
    if (const double sigma_T = field_.sigma_T(from_s); sigma_T > 0.)
      noise.rightCols<n_field_noises>() = sigma_T * field_slopes_;
  }

  bool TwinProcess::advance(const double from_s, const double to_s, Eigen::VectorXd &mean, Eigen::MatrixXd &transition,
                            Eigen::MatrixXd &noise)
  {
    transition.setIdentity();
    if (!go(from_s, to_s, mean, transition, 0))
      return false;
    set_noise(from_s, to_s - from_s, transition, noise);
    return true;
  }
} // namespace swimtwin
