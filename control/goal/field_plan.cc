#include <control/goal/field_plan.h>
#include <control/goal/measured_field.h>
#include <control/stroke/robust_search.h>
#include <datasets/system/error.h>
#include <rom/sweep/trained_ratios.h>
#include <rom/swimmer/carried_inertia.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double part_around = 0.1; // of each variable's range, for starts around a field

    void require_possible(const ReducedModel &model, const SwimmingGoal &goal)
    {
      if (goal.field.turn_rad != 0. && model.resistance.depends_on_angle)
        throw InputError(
            fmt::format("the model {} was trained between walls and knows one heading only; leave out [objective] "
                        "direction_deg, or plan with a model whose domain moves with the swimmer (open-2d).",
                        model.scene_name));
      if (!std::isfinite(largest_magnitude_T(goal.field)))
        throw InputError("the limits leave the field unbounded; give [limits] magnitude_T, or bx_T and by_T, or "
                         "coil currents of at least two coils.");
      if (goal.weights.empty())
        throw InputError("the goal has no objective; give [objective] mean_speed = 1 or another term.");
      if (!(goal.frequency_Hz.low <= goal.frequency_Hz.high) || goal.frequency_Hz.low <= 0.)
        throw InputError(fmt::format("no frequency lies between {:.4g} and {:.4g} Hz, the goal's limits within the "
                                     "model's trained range.",
                                     goal.frequency_Hz.low, goal.frequency_Hz.high));
    }

    /// The searches of one plan, one after the other.
    class Planner
    {
    public:
      Planner(const ReducedModel &model, const SwimmingGoal &goal, const Drive &reference,
              const FieldPlanOptions &options, const std::vector<SwimmerParameters> &members)
          : swimmer_(model, inertial_densities(model, goal.inertia)), goal_(goal), options_(options),
            members_(members), task_{model, swimmer_, goal_, {}}, sinusoids_(1, FieldFamily::sinusoid),
            fields_(goal.n_harmonics, goal.family), reference_{sinusoids_.drive(sinusoids_.variables(reference)),
                                                               state_at_rest(swimmer_, goal.heading_rad)}
      {
      }

      PlanResult plan()
      {
        const auto start = std::chrono::steady_clock::now();
        measure_reference();
        tune_sinusoid();
        measure_given();
        find_optimum();
        if (options_.gradient_free_budget > 0. && members_.empty())
          search_without_gradients();
        trade_off();
        measure_members();
        conclude();
        turn_fields();
        result_.seed          = options_.seed;
        result_.search_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(result_);
      }

    private:
      void tell(const std::string &what) const
      {
        if (options_.on_progress)
          options_.on_progress(what);
      }

      void measure_reference()
      {
        tell("the reference sinusoid");
        StrokeProblem problem(task_.model, swimmer_, goal_, sinusoids_, options_.search.stroke);
        const Stroke &stroke = problem.stroke(sinusoids_.variables(reference_.drive), false);
        if (!stroke.found())
          throw ComputationError(fmt::format(
              "the reference sinusoid makes no periodic motion that weights could be relative to: {}", stroke.failure));
        task_.sizes      = term_sizes(problem, goal_, stroke);
        reference_.state = stroke.orbit.start;
        result_.fields.push_back(measured_field(reference_field_name, task_, reference_.drive, reference_.state));
      }

      std::vector<FieldFound> search(const FieldVariables &variables, const std::vector<FieldStart> &starts) const
      {
        if (members_.empty())
          return search_fields(task_, variables, starts, options_.search);
        const int n_left_out = static_cast<int>(std::floor(goal_.robust.left_out * double(members_.size())));
        std::vector<FieldFound> found;
        for (const FieldStart &start : starts)
          found.push_back(search_robust_field(task_, members_, n_left_out, variables, start, options_.search));
        return found;
      }

      /// From the reference and from around it.
      void tune_sinusoid()
      {
        tell("the tuned sinusoid");
        std::vector<FieldStart> starts = {reference_};
        for (const FieldStart &start :
             starts_around(reference_, sinusoids_, goal_, options_.n_starts, part_around, options_.seed))
          starts.push_back(start);
        const std::vector<FieldFound> found = search(sinusoids_, starts);
        tuned_                              = start_from(best_of(found), reference_);
        result_.fields.push_back(measured_field(tuned_field_name, task_, found));
      }

      /// On from the tuned sinusoid, and from around it; through the symmetric fields, which the sinusoid belongs to,
      /// to the general ones.
      void find_optimum()
      {
        tell("the optimal field");
        std::vector<FieldStart> starts = starts_of_optimum();
        FieldFound              before;
        if (goal_.family == FieldFamily::general)
        {
          before         = search(FieldVariables(goal_.n_harmonics, FieldFamily::symmetric), {tuned_}).front();
          starts.front() = start_from(before, tuned_);
        }
        std::vector<FieldFound> found = search(fields_, starts);
        found.front().n_periods += before.n_periods;
        for (PlanTraceStep &step : found.front().trace)
        {
          step.n_periods += before.n_periods;
          step.n_evaluations += before.minimum.n_evaluations;
        }
        const FieldFound &best = best_of(found);
        optimal_               = start_from(best, tuned_);
        n_periods_of_best_     = best.n_periods;
        result_.fields.push_back(measured_field(optimal_field_name, task_, found));
      }

      std::vector<FieldStart> starts_of_optimum() const
      {
        std::vector<FieldStart> starts = {tuned_};
        if (options_.given)
          starts.push_back({*options_.given, tuned_.state});
        for (const FieldStart &start :
             starts_around(tuned_, fields_, goal_, options_.n_starts, part_around, options_.seed))
          starts.push_back(start);
        return starts;
      }

      static FieldStart start_from(const FieldFound &found, const FieldStart &otherwise)
      {
        return found.minimum.is_feasible() ? FieldStart{found.drive, found.start} : otherwise;
      }

      void search_without_gradients()
      {
        tell("a search without gradients");
        FieldSearchOptions options     = options_.search;
        options.search.method          = options_.gradient_free;
        options.search.max_evaluations = 1'000'000;
        options.search.max_restarts    = 1'000; // until its budget is spent, or a restart gains nothing
        options.max_periods = std::lround(options_.gradient_free_budget * static_cast<double>(n_periods_of_best_));
        const std::vector<FieldFound> found = {search_field(task_, fields_, tuned_, options)};
        result_.fields.push_back(measured_field(gradient_free_field_name, task_, found));
      }

      /// Both fields for each bound on the multiplier, each from the answer for the bound before.
      void trade_off()
      {
        FieldStart tuned = tuned_, optimal = optimal_;
        for (const double bound : options_.trade_off)
        {
          tell(fmt::format("both fields with multipliers up to {:.3g}", bound));
          SwimmingGoal goal              = goal_;
          goal.motion.largest_multiplier = bound;
          const FieldTask  task{task_.model, swimmer_, goal, task_.sizes};
          const FieldFound sinusoid          = search_field(task, sinusoids_, tuned, options_.search);
          tuned                              = start_from(sinusoid, tuned);
          const std::vector<FieldFound> both = search_fields(task, fields_, {optimal, tuned}, options_.search);
          optimal                            = start_from(best_of(both), optimal);
          result_.trade_off.push_back(point(task, bound, sinusoid, best_of(both)));
        }
      }

      static TradeOffPoint point(const FieldTask &task, const double bound, const FieldFound &tuned,
                                 const FieldFound &optimal)
      {
        TradeOffPoint point;
        point.largest_multiplier   = bound;
        point.tuned_speed_m_s      = measured_field("", task, tuned.drive, tuned.start).mean_speed_m_s;
        point.optimal_speed_m_s    = measured_field("", task, optimal.drive, optimal.start).mean_speed_m_s;
        point.tuned_frequency_Hz   = tuned.drive.frequency_Hz;
        point.optimal_frequency_Hz = optimal.drive.frequency_Hz;
        point.tuned_status         = to_string(tuned.minimum.status);
        point.optimal_status       = to_string(optimal.minimum.status);
        return point;
      }

      void measure_given()
      {
        if (options_.given)
          result_.fields.push_back(measured_field(given_field_name, task_, *options_.given, tuned_.state));
      }

      void measure_members()
      {
        for (const SwimmerParameters &member : members_)
        {
          SwimmingGoal goal = goal_;
          goal.swimmer      = member;
          const FieldTask    task{task_.model, swimmer_, goal, task_.sizes};
          const PlannedField best  = measured_field("", task, optimal_.drive, optimal_.state);
          const PlannedField tuned = measured_field("", task, tuned_.drive, tuned_.state);
          result_.members.push_back(
              {member.young_modulus_Pa, member.viscosity_Pa_s, member.magnetization_A_m, best.mean_speed_m_s,
               tuned.mean_speed_m_s,
               best.multipliers.empty() ? std::numeric_limits<double>::quiet_NaN() : best.multipliers.front()});
        }
      }

      void conclude()
      {
        const PlannedField &best = *result_.find(optimal_field_name);
        result_.status           = best.status;
        result_.message          = best.message;
        constexpr double noticed = 1e-3;
        if (best.moves && best.field_excess > noticed)
          result_.warnings.push_back(
              fmt::format("on a finer grid the optimal field exceeds a limit by {:.2g} %", 100. * best.field_excess));
        if (best.moves && best.motion_excess > noticed)
          result_.warnings.push_back(
              fmt::format("on a finer grid the motion exceeds a limit by {:.2g} %", 100. * best.motion_excess));
        warn_of_bounds(best);
        warn_of_range(best);
      }

      /// From the heading of the search to that of the goal.
      void turn_fields()
      {
        const Eigen::Rotation2Dd turn(goal_.field.turn_rad);
        for (PlannedField &field : result_.fields)
        {
          for (std::size_t i = 0; i < field.bx_T.size(); ++i)
          {
            const Eigen::Vector2d b = turn * Eigen::Vector2d(field.bx_T[i], field.by_T[i]);
            field.bx_T[i]           = b.x();
            field.by_T[i]           = b.y();
          }
          if (!field.start.empty())
            field.start[0] += goal_.field.turn_rad;
        }
        result_.heading_rad = goal_.heading_rad + goal_.field.turn_rad;
      }

      void warn_of_bounds(const PlannedField &best)
      {
        constexpr double near = 1e-3;
        if (best.moves && best.frequency_Hz > goal_.frequency_Hz.high * (1. - near))
          result_.warnings.push_back(
              fmt::format("the best frequency is the highest that was allowed, {:.4g} Hz", goal_.frequency_Hz.high));
        if (best.moves && std::isfinite(goal_.motion.shape_radius) &&
            best.largest_shape_radius > goal_.motion.shape_radius * (1. - near))
          result_.warnings.push_back("the tail bends as far as the model is trusted: what lies beyond is not known");
      }

      /// The model's shapes come from sinusoids of the trained range, on swimmers of its own.
      void warn_of_range(const PlannedField &best)
      {
        if (best.bx_T.empty())
          return;
        RunRequest request;
        request.parameters = goal_.swimmer;
        request.drive      = drive_of(best);
        if (const auto outside = notes_outside_range(task_.model.range, request); !outside.empty())
          result_.warnings.push_back(fmt::format("swimmer and frequency are not what the model was trained for ({}): "
                                                 "say --replay to know the true gain, or "
                                                 "train another model",
                                                 fmt::join(outside, "; ")));
        const Interval &bx = task_.model.range.bx_T, &by = task_.model.range.by_T;
        if (best.largest_field_T > std::hypot(bx.high, by.high) * (1. + 1e-3) || !bx.contains(best.bx_T.front()) ||
            best.by_T.size() > 3)
          result_.warnings.push_back(fmt::format(
              "the model's modes come from sinusoids with bx from {:.3g} to {:.3g} T and by from {:.3g} to "
              "{:.3g} T, and this field is another one: a --replay tells its true gain, --refine trains on its "
              "shapes",
              bx.low, bx.high, by.low, by.high));
      }

      const ReducedSwimmer                  swimmer_;
      const SwimmingGoal                    goal_;
      const FieldPlanOptions               &options_;
      const std::vector<SwimmerParameters> &members_;
      FieldTask                             task_;
      FieldVariables                        sinusoids_, fields_;
      FieldStart                            reference_, tuned_, optimal_;
      long                                  n_periods_of_best_ = 0;
      PlanResult                            result_;
    };
  } // namespace

  PlanResult plan_field(const ReducedModel &model, const SwimmingGoal &goal, const Drive &reference,
                        const FieldPlanOptions &options, const std::vector<SwimmerParameters> &members)
  {
    require_possible(model, goal);
    return Planner(model, goal, reference, options, members).plan();
  }
} // namespace swimtwin
