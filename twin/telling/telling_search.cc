#include <control/steering/steered_field.h>
#include <twin/steering/coil_limiter.h>
#include <twin/telling/telling_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double     small_change = 0.05; ///< of a factor's logarithm
    constexpr std::array steps        = {0.5, 0.25, 0.12, 0.06};
    constexpr double     worth_saying = 0.01; ///< of the standard deviation
    constexpr double     slower       = 0.05;
  } // namespace

  TellingSearch::TellingSearch(const ReducedModel &model, const TwinOptions &twin, const TellingOptions &options)
      : options_(options), trial_(model, twin)
  {
  }

  void TellingSearch::begin(const SwimmerTwin &twin, const Drive &drive, const double drive_start_s)
  {
    trial_.begin(twin, drive, drive_start_s);
    drive_        = drive;
    time_s_       = twin.now_s();
    duration_s_   = options_.ahead_periods / drive.frequency_Hz;
    n_trials_     = 0;
    slopes_       = Variables::Zero();
    speed_slopes_ = Variables::Zero();
    is_searching_ = true;
  }

  FieldChange TellingSearch::within_limits(const Variables &x) const
  {
    FieldChange  change{std::exp(x[0]), std::exp(x[1]), std::exp(x[2])};
    const double f = drive_.frequency_Hz;
    change.frequency_times =
        std::clamp(change.frequency_times, std::min(1., options_.lowest_Hz / f), std::max(1., options_.highest_Hz / f));
    // A drive that is beyond the limits itself may stay as it is.
    const double allowed = std::max(1., use_of_limits(drive_)), asked = use_of_limits(changed(drive_, change));
    if (asked > allowed)
    {
      change.bx_times *= allowed / asked;
      change.by_times *= allowed / asked;
    }
    return change;
  }

  double TellingSearch::use_of_limits(const Drive &drive) const
  {
    constexpr int     n_phases = 96, n_angles = 24;
    const CoilLimiter coils(options_.coils);
    double            use = largest_T(drive) / options_.largest_T;
    for (int i = 0; i < n_phases; ++i)
    {
      const Eigen::Vector2d b    = drive.field->value_T(static_cast<double>(i) / n_phases, drive.parameters),
                            next = drive.field->value_T((i + 1.) / n_phases, drive.parameters);
      for (int k = 0; k < n_angles; ++k)
        use = std::max(use, coils.use_of(Eigen::Rotation2Dd(2. * std::numbers::pi * k / n_angles) * b));
      use = std::max(use, (next - b).norm() * n_phases * drive.frequency_Hz / options_.coils.slew_rate_T_s);
    }
    return use;
  }

  std::optional<TrialResult> TellingSearch::trial(const FieldChange &change)
  {
    return trial_.run(change, options_.parameter, duration_s_);
  }

  void TellingSearch::choose_direction()
  {
    direction_ = -slopes_;
    if (options_.keeps_speed && direction_.dot(speed_slopes_) < 0.)
      direction_ -= direction_.dot(speed_slopes_) / speed_slopes_.squaredNorm() * speed_slopes_;
    if (const double size = direction_.norm(); size > 0.)
      direction_ /= size;
  }

  std::optional<TellingField> TellingSearch::finish(const FieldChange &change, const TrialResult &result,
                                                    const bool is_better)
  {
    is_searching_ = false;
    return TellingField{
        options_.parameter, time_s_, duration_s_, drive_, changed(drive_, change), change, as_is_, result, is_better};
  }

  std::optional<TellingField> TellingSearch::go_on()
  {
    if (!is_searching_)
      return std::nullopt;
    const int number = n_trials_++;
    if (number == 0)
    {
      const auto result = trial({});
      is_searching_     = result.has_value();
      if (result)
        as_is_ = *result;
      return std::nullopt;
    }
    const auto speed_change = [&](const TrialResult &r) {
      return r.speed_m_s / std::max(as_is_.speed_m_s, 1e-300) - 1.;
    };
    if (number <= n_variables)
    {
      FieldChange change;
      (number == 1 ? change.bx_times : number == 2 ? change.by_times : change.frequency_times) = std::exp(small_change);
      if (const auto result = trial(change))
      {
        slopes_[number - 1]       = std::log(result->standard_deviation / as_is_.standard_deviation) / small_change;
        speed_slopes_[number - 1] = speed_change(*result) / small_change;
      }
      if (number == n_variables)
        choose_direction();
      return std::nullopt;
    }
    const FieldChange change = within_limits(steps[static_cast<std::size_t>(number - n_variables - 1)] * direction_);
    const auto        result = trial(change);
    const bool is_better     = result && result->standard_deviation < (1. - worth_saying) * as_is_.standard_deviation &&
                           (!options_.keeps_speed || speed_change(*result) >= -slower);
    if (is_better)
      return finish(change, *result, true);
    if (number == n_variables + static_cast<int>(steps.size()))
      return finish({}, as_is_, false);
    return std::nullopt;
  }
} // namespace swimtwin
