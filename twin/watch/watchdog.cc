#include <twin/watch/watchdog.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// That chi-squared with n degrees of freedom is larger.
    double upper_probability(const double chi_squared, const int n)
    {
      if (n == 0 || !(chi_squared > 0.))
        return 1.;
      constexpr double beyond_doubles = 1e4;
      if (chi_squared > beyond_doubles * n)
        return 0.;
      return boost::math::cdf(boost::math::complement(boost::math::chi_squared(n), chi_squared));
    }

    /// Of a point to the nearest wall; infinite in a domain that moves with the swimmer.
    double wall_distance_m(const Domain &domain, const Eigen::Vector2d &point_m)
    {
      if (domain.moves_with_swimmer)
        return std::numeric_limits<double>::infinity();
      const Eigen::Vector2d p = point_m - Eigen::Vector2d(domain.center_m[0], domain.center_m[1]);
      if (domain.shape == DomainShape::disc)
        return domain.radius_m - p.norm();
      if (domain.shape == DomainShape::annulus)
        return std::min(domain.radius_m - p.norm(), p.norm() - domain.inner_radius_m);
      return std::min(0.5 * domain.size_m[0] - std::abs(p.x()), 0.5 * domain.size_m[1] - std::abs(p.y()));
    }
  } // namespace

  Watchdog::Watchdog(const SwimmerTwin &twin, const ReducedModel &model, const WatchOptions &options,
                     const double drive_period_s)
      : twin_(twin), domain_(parse_scene(model.scene_text, model.scene_name + ".toml").domain), options_(options),
        period_s_(drive_period_s)
  {
  }

  bool Watchdog::is_on(const std::string &name) const
  {
    return std::any_of(on_.begin(), on_.end(), [&](const Alarm &alarm) { return alarm.name == name; });
  }

  std::vector<std::string> Watchdog::flags() const
  {
    std::vector<std::string> names;
    for (const Alarm &alarm : on_)
      names.push_back(alarm.name);
    return names;
  }

  double Watchdog::trust(const double time_s) const
  {
    constexpr double doubtful = 0.01;
    const double     region   = std::clamp(2. - shape_radius_, 0., 1.);
    const double     blind_s  = std::max(0., time_s - last_used_s_ - options_.sight_lost_s);
    return std::min(1., consistency_ / doubtful) * region * std::exp(-blind_s / period_s_);
  }

  void Watchdog::judge(const char *name, const bool is_bad, const double since_s, const std::string &what,
                       const std::string &remedy, std::vector<Alarm> &changes)
  {
    const auto found = std::find_if(on_.begin(), on_.end(), [&](const Alarm &alarm) { return alarm.name == name; });
    if (is_bad && found == on_.end())
    {
      on_.push_back({name, since_s, what, remedy});
      changes.push_back(on_.back());
    }
    if (!is_bad && found != on_.end())
    {
      found->is_over = true;
      changes.push_back(*found);
      on_.erase(found);
    }
  }

  void Watchdog::judge_innovations(std::vector<Alarm> &changes)
  {
    double frame_sum = 0.;
    int    frame_n   = 0;
    for (const Innovation &innovation : twin_.filter().latest().innovations)
    {
      frame_sum += innovation.distance_squared;
      frame_n += innovation.n_rows;
      if (innovation.weight <= 0.)
        continue;
      distances_.emplace_back(innovation.distance_squared, innovation.n_rows);
      sum_ += innovation.distance_squared;
      n_degrees_ += innovation.n_rows;
      if (distances_.size() > static_cast<std::size_t>(options_.n_consistency))
      {
        sum_ -= distances_.front().first;
        n_degrees_ -= distances_.front().second;
        distances_.pop_front();
      }
    }
    significance_        = upper_probability(frame_sum, frame_n);
    const bool is_full   = distances_.size() == static_cast<std::size_t>(options_.n_consistency);
    const bool is_judged = is_full && twin_.now_s() - twin_.started_s() > 2. * period_s_;
    consistency_         = is_judged ? upper_probability(sum_, n_degrees_) : 1.;
    judge(watch_flag::inconsistent, consistency_ < options_.consistency, twin_.now_s(),
          fmt::format("the last {} innovations are {:.2f} times as large as they should be (squares)",
                      distances_.size(), n_degrees_ > 0 ? sum_ / n_degrees_ : 0.),
          "state larger sigmas, or let more parameters drift in [parameters]; do not trust the standard deviations",
          changes);
  }

  void Watchdog::judge_region(std::vector<Alarm> &changes)
  {
    const Eigen::VectorXd &mean = twin_.belief().mean;
    const ShapeVector      q    = mean.segment(3, twin_.swimmer().n_modes());
    shape_radius_ =
        std::max(twin_.swimmer().resistance().shape_radius(q), twin_.swimmer().resistance().angle_radius(mean[2]));
    judge(watch_flag::outside_trained_region, shape_radius_ > 1., twin_.now_s(),
          fmt::format("the shape is {:.2f} times the radius that the model was trained in", shape_radius_),
          "weaken the field, or train the model for larger strokes", changes);
  }

  void Watchdog::judge_walls(std::vector<Alarm> &changes)
  {
    const double distance_m = domain_ ? wall_distance_m(*domain_, twin_.belief().mean.head<2>())
                                      : std::numeric_limits<double>::infinity(),
                 least_m    = options_.wall_clearance * twin_.swimmer().length_m();
    judge(watch_flag::near_wall, distance_m < least_m, twin_.now_s(),
          fmt::format("the head's centre is {:.3g} m from a wall of the model's domain", distance_m),
          "turn away; the model does not know the wall's drag there", changes);
  }

  /// The moment points against the field for half a period.
  void Watchdog::judge_step_out(const Eigen::Vector2d &field_T, std::vector<Alarm> &changes)
  {
    const double          angle = twin_.belief().mean[2];
    const double          sign  = twin_.options().nominal.magnetization_A_m < 0. ? -1. : 1.;
    const Eigen::Vector2d moment(sign * std::cos(angle), sign * std::sin(angle));
    if (field_T.dot(moment) >= 0.)
      against_since_s_ = twin_.now_s();
    judge(watch_flag::step_out, twin_.now_s() - against_since_s_ > 0.5 * options_.step_out_turns * period_s_,
          against_since_s_, "the head points against the field and does not follow it",
          "play the field slower or stronger until the head follows, then go on", changes);
  }

  void Watchdog::judge_frozen(const Frame &frame, std::vector<Alarm> &changes)
  {
    const bool is_same = frame.observations == last_seen_;
    n_same_            = is_same ? n_same_ + 1 : 1;
    if (!is_same)
      same_since_s_ = frame.time_s;
    last_seen_ = frame.observations;
    judge(watch_flag::frozen, n_same_ >= options_.frozen_frames, same_since_s_,
          fmt::format("{} frames show exactly the same, to the last digit", n_same_),
          "look whether the camera or its tracker hangs", changes);
  }

  void Watchdog::judge_sight(const double time_s, std::vector<Alarm> &changes)
  {
    judge(watch_flag::sight_lost, time_s - last_used_s_ > options_.sight_lost_s, last_used_s_,
          fmt::format("no frame could be used for {:.3g} s", time_s - last_used_s_),
          "play a safe field and look at the camera; the forecast goes on with the model alone", changes);
  }

  std::vector<Alarm> Watchdog::look(const Frame &frame, const Eigen::Vector2d &field_T)
  {
    std::vector<Alarm> changes;
    const double       now_s = twin_.now_s();
    if (distances_.empty())
      last_used_s_ = against_since_s_ = now_s;
    const bool is_used = has_used_sighting(twin_.filter().latest().innovations);
    // What went on in the dark is said before it ends.
    judge_sight(now_s, changes);
    if (is_used)
      last_used_s_ = now_s;
    judge_sight(now_s, changes);
    judge_innovations(changes);
    judge_region(changes);
    judge_walls(changes);
    judge_step_out(field_T, changes);
    judge_frozen(frame, changes);
    if (const auto &jump = twin_.alarm())
    {
      const JumpFinding &f = jump->finding;
      changes.push_back({"jump: " + jump->name, f.since_s,
                         fmt::format("{} changed at once, by {:+.3g} +- {:.2g} when it was found", jump->name, f.size,
                                     f.standard_deviation),
                         "look at the swimmer and the set-up; the estimate has been widened and follows"});
    }
    return changes;
  }

  std::vector<Alarm> Watchdog::wait(const double time_s)
  {
    std::vector<Alarm> changes;
    if (twin_.has_started() && last_used_s_ > 0.)
      judge_sight(time_s, changes);
    return changes;
  }
} // namespace swimtwin
