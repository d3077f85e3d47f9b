#include <datasets/system/error.h>
#include <twin/lab/laboratory.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double coil_interval_s = 2e-3; // between samples of what the coils play

    /// Everything stands in the state, so that anything may change.
    TwinParameters all_in_the_state(TwinParameters truth)
    {
      for (DriftingParameter &parameter : truth.list)
        parameter.standard_deviation = 1.;
      return truth;
    }

    bool is_ideal(const LaboratoryCoils &coils)
    {
      return coils.lag_s <= 0. && coils.quantisation_T <= 0.;
    }
  } // namespace

  Laboratory::Laboratory(const ReducedSwimmer &swimmer, const TailAxis &axis, const LaboratoryOptions &options)
      : options_(options),
        process_(swimmer, options.nominal, TwinLayout(all_in_the_state(options.truth), swimmer.n_states()),
                 is_ideal(options.coils) ? command_ : played_, options.noise, options.largest_step_s),
        camera_(process_, axis, {}), state_(Eigen::VectorXd::Zero(process_.n_states())),
        transition_(process_.n_states(), process_.n_states()), noise_(process_.n_states(), process_.n_noises()),
        random_(options.seed)
  {
    if (options.first_state.size() > 0)
      state_.head(swimmer.n_states()) = options.first_state;
    for (int i = 0; i < n_twin_parameters; ++i)
      state_[swimmer.n_states() + i] = options.truth.list[static_cast<std::size_t>(i)].value;
  }

  Eigen::VectorXd Laboratory::truth_in(const TwinLayout &other) const
  {
    Eigen::VectorXd state(other.n_states());
    state.head(other.n_swimmer()) = state_.head(other.n_swimmer());
    for (int i = 0; i < n_twin_parameters; ++i)
      if (const auto p = static_cast<TwinParameter>(i); other.is_estimated(p))
        state[other.place(p)] = state_[layout().place(p)];
    return state;
  }

  void Laboratory::play_coils(const double to_s)
  {
    const auto &[lag_s, step_T] = options_.coils;
    while (coils_s_ < to_s + coil_interval_s)
    {
      coils_s_ += coil_interval_s;
      const Eigen::Vector2d wanted = command_.value_T(coils_s_);
      const double          share  = lag_s > 0. ? 1. - std::exp(-coil_interval_s / lag_s) : 1.;
      coil_T_ += share * (wanted - coil_T_);
      const auto rounded = [step = step_T](const double v) { return step > 0. ? step * std::round(v / step) : v; };
      played_.add({coils_s_, {rounded(coil_T_.x()), rounded(coil_T_.y())}});
    }
    played_.forget_before(now_s_ - 1.);
  }

  void Laboratory::apply_changes(const double from_s, const double to_s)
  {
    for (const SuddenChange &change : options_.changes)
      if (change.time_s >= from_s && change.time_s < to_s)
        state_[layout().place(change.parameter)] += change.change;
    const TemperatureRamp &ramp      = options_.ramp;
    const double           warming_s = std::max(0., std::min(to_s, ramp.end_s) - std::max(from_s, ramp.start_s));
    const double           thinner   = -ramp.viscosity_per_K * ramp.rate_K_s * warming_s;
    state_[layout().place(TwinParameter::stiffness)] += thinner;
    state_[layout().place(TwinParameter::magnetization)] += thinner;
  }

  void Laboratory::advance(const double to_s)
  {
    if (!is_ideal(options_.coils))
      play_coils(to_s);
    const double start_s = now_s_;
    const int    n       = std::max(1, static_cast<int>(std::ceil((to_s - start_s) / options_.largest_step_s - 1e-9)));
    for (int i = 1; i <= n; ++i)
    {
      const double next_s = i == n ? to_s : start_s + (to_s - start_s) * i / n;
      apply_changes(now_s_, next_s);
      if (!process_.advance(now_s_, next_s, state_, transition_, noise_))
        throw ComputationError(
            fmt::format("the laboratory's swimmer was lost {:.4g} s after its start: Newton's method "
                        "found no step.",
                        now_s_));
      const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(noise_.cols(), [this] { return normal_(random_); });
      state_ += noise_ * w;
      now_s_ = next_s;
    }
  }

  Sighting Laboratory::noisy(const int kind, const double place, const double sigma)
  {
    Sighting        observation{kind, {0., 0.}, sigma, place};
    const auto      m = camera_.n_rows(observation);
    Eigen::VectorXd residual(m);
    Eigen::MatrixXd slopes(m, state_.size());
    // The delay is in the stamp: what is seen is of now.
    camera_.reference_delay_s = state_[layout().place(TwinParameter::camera_delay)];
    camera_.look(observation, now_s_, state_, residual, slopes);
    for (Eigen::Index i = 0; i < m; ++i)
      observation.value[i] = -residual[i] + sigma * normal_(random_);
    return observation;
  }

  CapturedFrame Laboratory::next_frame()
  {
    const LaboratoryCamera                &camera = options_.camera;
    std::uniform_real_distribution<double> uniform;
    advance(next_frame_s());
    ++n_frames_;
    CapturedFrame frame{now_s_ + state_[layout().place(TwinParameter::camera_delay)], 0., {}};
    frame.arrives_s = frame.stamp_s + std::max(0., camera.latency_s + camera.latency_jitter_s * normal_(random_));
    std::vector<Sighting> seen = {noisy(head_position, 0., camera.position_sigma_m)};
    if (camera.sees_angle)
      seen.push_back(noisy(head_angle, 0., camera.angle_sigma_rad));
    for (const double share : camera.tail_shares)
      seen.push_back(noisy(tail_point, share, camera.position_sigma_m));
    // The same random numbers are drawn whatever goes wrong, so that runs can be compared.
    const bool is_missing  = uniform(random_) < camera.missing_share,
               is_outlier  = uniform(random_) < camera.outlier_share;
    const double direction = 2. * std::numbers::pi * uniform(random_);
    if (is_outlier)
    {
      seen.front().value += camera.outlier_m * Eigen::Vector2d(std::cos(direction), std::sin(direction));
      for (Sighting &o : seen)
        if (o.kind == head_angle)
          o.value[0] += direction - std::numbers::pi;
    }
    const auto within = [&](const std::vector<TimeSpan> &spans) {
      return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan &s) { return s.contains(now_s_); });
    };
    if (within(camera.stuck) && !last_seen_.empty())
      seen = last_seen_;
    last_seen_ = seen;
    if (!is_missing && !within(camera.dark))
      frame.observations = std::move(seen);
    return frame;
  }
} // namespace swimtwin
