#include <control/steering/closed_loop.h>
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <rom/sensitivity/periodic_orbit.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <random>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;

    /// Sideways shift of the head when the body turns back to the field, from an angle off it.
    double shift_when_turned(const ReducedSwimmer &swimmer, const RunRequest &periodic, const double angle)
    {
      SwimmerIntegrator integrator(swimmer, {.relative_tolerance = 1e-8});
      RunRequest        turned = periodic;
      turned.initial_state[2] += angle;
      turned.n_periods     = 6;
      const SwimmerRun run = integrator.run(turned);
      if (!run.completed())
        throw ComputationError(run.failure);
      return run.at_period_end.back()[1];
    }

    class ClosedLoop
    {
    public:
      ClosedLoop(const ReducedSwimmer &model, const SwimmerParameters &parameters, const Drive &carrier,
                 const Path &path, Plant &plant, const ClosedLoopOptions &options)
          : model_(model), parameters_(parameters), path_(path), plant_(plant), options_(options),
            motion_(carrier_motion(model, parameters, carrier)), random_(options.seed),
            interval_(carrier.frequency_Hz / options.decisions_per_second), state_(state_at_rest(model))
      {
        require_followable(path, motion_.lever_m);
        const double knots = (options.warm_up_periods + options.max_periods + options.follower.horizon_periods) /
                             result_.plan.knot_periods;
        result_.plan.carrier    = carrier;
        result_.plan.angles_rad = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(std::ceil(knots)) + 8);
        result_.advance_m       = motion_.advance_m;
        result_.lever_m         = motion_.lever_m;
      }

      TrackResult run()
      {
        record_pose(0.);
        try
        {
          warm_up();
          place_path();
          follow(now_ + options_.max_periods, true);
        }
        catch (const ComputationError &error)
        {
          fail(error);
        }
        summarise();
        return std::move(result_);
      }

      TrackResult play(const TrackResult &planned)
      {
        record_pose(0.);
        result_.plan = planned.plan;
        result_.path = path_ = planned.path;
        try
        {
          warm_up();
          follow(planned.end_periods, false);
        }
        catch (const ComputationError &error)
        {
          fail(error);
        }
        summarise();
        return std::move(result_);
      }

    private:
      void fail(const ComputationError &error)
      {
        result_.status  = TrackStatus::failed;
        result_.message = error.what();
      }

      double frequency_Hz() const { return result_.plan.carrier.frequency_Hz; }

      /// The plant's, as long ago as the delay says; before anything was seen, the first.
      Pose delayed_pose()
      {
        poses_.emplace_back(now_, plant_.pose());
        const double seen = now_ - options_.delay_s * frequency_Hz();
        while (poses_.size() > 1 && poses_[1].first <= seen + 1e-9)
          poses_.pop_front();
        return poses_.front().second;
      }

      Pose measure()
      {
        std::normal_distribution<double> normal;
        Pose                             pose = delayed_pose();
        const double                     s    = options_.position_noise * model_.length_m();
        pose.position_m += Eigen::Vector2d(s * normal(random_), s * normal(random_));
        pose.angle_rad += options_.angle_noise_rad * normal(random_);
        return pose;
      }

      /// The shape is not seen: it is the model's.
      void correct(const Pose &measured)
      {
        state_.head<2>() += options_.position_gain * (measured.position_m - state_.head<2>());
        state_[2] += options_.angle_gain * (measured.angle_rad - state_[2]);
      }

      void record_pose(const double now)
      {
        truth_.add(now, plant_.pose().position_m);
        angles_.add(now, {plant_.pose().angle_rad, 0.});
        believed_.add(now, state_.head<2>());
      }

      /// The model beside the plant.
      void predict(const double now, const double next)
      {
        ReducedPlant model(model_, parameters_, state_, options_.follower.relative_tolerance);
        model.advance(result_.plan, now, next);
        state_ = model.state();
      }

      void warm_up()
      {
        while (now_ < options_.warm_up_periods - 1e-9)
          go_on();
        result_.start_periods = now_;
      }

      void place_path()
      {
        path_ = path_.placed(pi, believed_.mean_at(now_));
        follower_.emplace(model_, parameters_, path_, motion_.advance_m, options_.follower);
        result_.path = path_;
      }

      /// One improvement of the plan, used if it is in time.
      void decide(TrackedInstant &instant)
      {
        const double start     = thread_cpu_time_s();
        SteeringPlan improved  = result_.plan;
        FollowerStep decision  = follower_->improve(improved, now_, now_ + interval_, state_, believed_, believed_arc_);
        instant.decision_cpu_s = thread_cpu_time_s() - start;
        instant.decided =
            decision.completed && (options_.deadline_s <= 0. || instant.decision_cpu_s <= options_.deadline_s);
        if (instant.decided)
        {
          result_.plan  = std::move(improved);
          believed_arc_ = decision.arc_m;
        }
      }

      void describe(TrackedInstant &instant)
      {
        const PathPlace place     = path_.nearest(truth_.mean_at(now_), true_arc_,
                                                  std::min(true_arc_ + 0.5 * model_.length_m(), path_.length_m()));
        true_arc_                 = std::max(true_arc_, place.arc_m);
        instant.time_s            = now_ / frequency_Hz();
        instant.pose              = plant_.pose();
        instant.measured          = measured_;
        instant.estimated         = {state_.head<2>(), state_[2]};
        instant.mean_m            = truth_.mean_at(now_);
        instant.path_m            = place.point_m;
        instant.arc_m             = place.arc_m;
        instant.distance_m        = (instant.mean_m - place.point_m).norm();
        const double along        = std::atan2(-place.tangent.y(), -place.tangent.x());
        instant.heading_error_rad = std::remainder(angles_.mean_at(now_)[0] - along, 2. * pi);
        instant.field_T           = result_.plan.field_T(now_);
      }

      bool has_arrived() const
      {
        const double left = path_.length_m() - true_arc_;
        return left <= options_.end_distance * model_.length_m();
      }

      /// Until the path or the time ends.
      void follow(const double end, const bool is_led)
      {
        while (now_ < end - 1e-9 && !(is_led && has_arrived()))
        {
          TrackedInstant instant;
          if (is_led)
            decide(instant);
          describe(instant);
          result_.instants.push_back(instant);
          go_on();
          if (options_.on_progress)
            options_.on_progress(true_arc_ / path_.length_m());
        }
        result_.status = has_arrived() ? TrackStatus::arrived : TrackStatus::not_arrived;
        if (!has_arrived())
          result_.message = fmt::format("the swimmer was {:.3g} m along a path of {:.3g} m when its time ended",
                                        true_arc_, path_.length_m());
      }

      /// To the next decision: the plant moves, the model moves beside it, and is corrected by what is seen.
      void go_on()
      {
        plant_.advance(result_.plan, now_, now_ + interval_);
        predict(now_, now_ + interval_);
        now_ += interval_;
        measured_ = measure();
        correct(measured_);
        record_pose(now_);
      }

      std::vector<PoseInstant> poses() const
      {
        std::vector<PoseInstant> poses;
        for (const TrackedInstant &i : result_.instants)
          poses.push_back({i.time_s * frequency_Hz(), i.pose, i.arc_m});
        return poses;
      }

      /// Both paths begin together; arc lengths correspond by their shares.
      double distance_of_point(const LedPoint &point) const
      {
        const Path   path  = point.path.placed(pi, path_.points_m().front());
        const double share = path.length_m() / path_.length_m(), reach = 0.5 * model_.length_m();
        double       sum = 0.;
        for (const TrackedInstant &i : result_.instants)
        {
          const double          angle = i.pose.angle_rad, arc = share * i.arc_m;
          const Eigen::Vector2d place =
              i.pose.position_m + point.behind_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
          sum +=
              (place - path.nearest(place, std::max(0., arc - reach), std::min(arc + reach, path.length_m())).point_m)
                  .squaredNorm();
        }
        return std::sqrt(sum / static_cast<double>(result_.instants.size()));
      }

      void summarise()
      {
        result_.end_periods = now_;
        const auto n        = static_cast<double>(std::max<std::size_t>(1, result_.instants.size()));
        for (const TrackedInstant &instant : result_.instants)
        {
          result_.rms_distance_m += instant.distance_m * instant.distance_m / n;
          result_.rms_swing_m += (instant.pose.position_m - instant.path_m).squaredNorm() / n;
          result_.rms_heading_rad += instant.heading_error_rad * instant.heading_error_rad / n;
          result_.mean_decision_s += instant.decision_cpu_s / n;
          result_.largest_distance_m = std::max(result_.largest_distance_m, instant.distance_m);
          result_.largest_decision_s = std::max(result_.largest_decision_s, instant.decision_cpu_s);
          result_.n_missed += instant.decision_cpu_s > 0. && !instant.decided;
        }
        result_.n_decisions = static_cast<int>(result_.instants.size());
        result_.axis        = swing_along_axis(poses(), path_, model_.length_m());
        for (double *square : {&result_.rms_distance_m, &result_.rms_swing_m, &result_.rms_heading_rad})
          *square = std::sqrt(*square);
        if (options_.point && !result_.instants.empty())
          result_.rms_point_m = distance_of_point(*options_.point);
      }

      const ReducedSwimmer               &model_;
      SwimmerParameters                   parameters_;
      Path                                path_;
      Plant                              &plant_;
      ClosedLoopOptions                   options_;
      CarrierMotion                       motion_;
      std::mt19937                        random_;
      double                              interval_; ///< carrier periods
      SwimmerState                        state_;    ///< estimated
      Pose                                measured_;
      std::optional<PathFollower>         follower_;
      MeanPosition                        truth_, angles_, believed_;
      std::deque<std::pair<double, Pose>> poses_; ///< of the plant, the delay back
      double                              now_ = 0., true_arc_ = 0., believed_arc_ = 0.;
      TrackResult                         result_;
    };
  } // namespace

  std::string to_string(const TrackStatus status)
  {
    switch (status)
    {
    case TrackStatus::not_run:
      return "not run";
    case TrackStatus::arrived:
      return "arrived";
    case TrackStatus::not_arrived:
      return "not arrived";
    case TrackStatus::failed:
      return "failed";
    }
    return "";
  }

  CarrierMotion carrier_motion(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &carrier)
  {
    RunRequest          request{parameters, carrier, state_at_rest(swimmer), 1, 0};
    const PeriodicOrbit orbit = PeriodicOrbitFinder(swimmer).find(request);
    if (!orbit.converged() || !orbit.is_stable())
      throw ComputationError(fmt::format("the carrier field gives no stable periodic motion: {}",
                                         orbit.converged() ? "disturbances of it grow" : orbit.failure));
    constexpr double small = 0.01; // rad
    request.initial_state  = orbit.start;
    const double shift     = shift_when_turned(swimmer, request, small) - shift_when_turned(swimmer, request, -small);
    return {orbit.drift_m.norm(), std::abs(shift) / (2. * small)};
  }

  TrackResult run_closed_loop(const ReducedSwimmer &model, const SwimmerParameters &model_parameters,
                              const Drive &carrier, const Path &path, Plant &plant, const ClosedLoopOptions &options)
  {
    return ClosedLoop(model, model_parameters, carrier, path, plant, options).run();
  }

  TrackResult play_plan(const ReducedSwimmer &model, const SwimmerParameters &model_parameters,
                        const TrackResult &planned, Plant &plant, const ClosedLoopOptions &options)
  {
    return ClosedLoop(model, model_parameters, planned.plan.carrier, planned.path, plant, options).play(planned);
  }

  TrackResult follow_path(const ReducedSwimmer &model, const SwimmerParameters &parameters, const Drive &carrier,
                          const Path &path, ClosedLoopOptions options)
  {
    options.position_noise = options.angle_noise_rad = 0.;
    options.deadline_s                               = 0.;
    ReducedPlant plant(model, parameters, state_at_rest(model));
    return run_closed_loop(model, parameters, carrier, path, plant, options);
  }
} // namespace swimtwin
