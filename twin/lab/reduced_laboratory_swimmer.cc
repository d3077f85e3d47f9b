#include <twin/lab/reduced_laboratory_swimmer.h>

#include <datasets/system/error.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Everything stands in the state, so that anything may change.
    TwinParameters all_in_the_state(TwinParameters truth)
    {
      for (DriftingParameter &parameter : truth.list)
        parameter.standard_deviation = 1.;
      return truth;
    }
  } // namespace

  ReducedLaboratorySwimmer::ReducedLaboratorySwimmer(const ReducedSwimmer &swimmer, const TailAxis &axis,
                                                     const FieldSignal &played, const LaboratoryOptions &options)
      : swimmer_(swimmer), axis_(axis), ramp_(options.ramp), changes_(options.changes),
        largest_step_s_(options.largest_step_s),
        process_(swimmer, options.nominal, TwinLayout(all_in_the_state(options.truth), swimmer.n_states()), played,
                 options.noise, options.largest_step_s),
        state_(Eigen::VectorXd::Zero(process_.n_states())), transition_(process_.n_states(), process_.n_states()),
        noise_(process_.n_states(), process_.n_noises())
  {
    if (options.first_state.size() > 0)
      state_.head(swimmer.n_states()) = options.first_state;
    for (int i = 0; i < n_twin_parameters; ++i)
      state_[swimmer.n_states() + i] = options.truth.list[static_cast<std::size_t>(i)].value;
  }

  void ReducedLaboratorySwimmer::apply_changes(const double from_s, const double to_s)
  {
    for (const SuddenChange &change : changes_)
      if (change.time_s >= from_s && change.time_s < to_s)
        state_[layout().place(change.parameter)] += change.change;
    const double warming_s = std::max(0., std::min(to_s, ramp_.end_s) - std::max(from_s, ramp_.start_s));
    const double thinner   = -ramp_.viscosity_per_K * ramp_.rate_K_s * warming_s;
    state_[layout().place(TwinParameter::stiffness)] += thinner;
    state_[layout().place(TwinParameter::magnetization)] += thinner;
  }

  void ReducedLaboratorySwimmer::advance(const double to_s, Chance &chance)
  {
    const double start_s = now_s_;
    const int    n       = std::max(1, static_cast<int>(std::ceil((to_s - start_s) / largest_step_s_ - 1e-9)));
    for (int i = 1; i <= n; ++i)
    {
      const double next_s = i == n ? to_s : start_s + (to_s - start_s) * i / n;
      apply_changes(now_s_, next_s);
      if (!process_.advance(now_s_, next_s, state_, transition_, noise_))
        throw ComputationError(
            fmt::format("the laboratory's swimmer was lost {:.4g} s after its start: Newton's method "
                        "found no step.",
                        now_s_));
      const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(noise_.cols(), [&] { return chance.normal(); });
      state_ += noise_ * w;
      now_s_ = next_s;
    }
  }

  Eigen::Vector2d ReducedLaboratorySwimmer::tail_point_m(const double share) const
  {
    const ShapeVector q = state_.segment(3, swimmer_.n_modes());
    return head_m() + Eigen::Rotation2Dd(angle_rad()) * axis_.position_m(share, q);
  }

  std::vector<std::string> ReducedLaboratorySwimmer::truth_names() const
  {
    std::vector<std::string> names = {"x_m", "y_m", "angle_rad"};
    for (int i = 1; i <= swimmer_.n_modes(); ++i)
      names.push_back(fmt::format("shape_{}_m", i));
    names.insert(names.end(), twin_parameter_names.begin(), twin_parameter_names.end());
    return names;
  }

  Eigen::VectorXd ReducedLaboratorySwimmer::truth() const
  {
    Eigen::VectorXd some(swimmer_.n_velocities() + n_twin_parameters);
    some << state_.head(swimmer_.n_velocities()), state_.tail(n_twin_parameters);
    return some;
  }

  Eigen::VectorXd ReducedLaboratorySwimmer::truth_in(const TwinLayout &other) const
  {
    Eigen::VectorXd state(other.n_states());
    state.head(other.n_swimmer()) = state_.head(other.n_swimmer());
    for (int i = 0; i < n_twin_parameters; ++i)
      if (const auto p = static_cast<TwinParameter>(i); other.is_estimated(p))
        state[other.place(p)] = state_[layout().place(p)];
    return state;
  }
} // namespace swimtwin
