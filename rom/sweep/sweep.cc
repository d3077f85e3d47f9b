#include <datasets/reduced/held_out_error.h>
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <datasets/system/parallel_for.h>
#include <rom/sweep/starting_state.h>
#include <rom/sweep/sweep.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace swimtwin
{
  namespace
  {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

    std::size_t count(const std::vector<double> &values)
    {
      return std::max<std::size_t>(1, values.size());
    }

    bool is_sinusoidal(const Drive &drive)
    {
      return dynamic_cast<const SinusoidalField *>(drive.field.get()) != nullptr;
    }

    /// The member's place on each axis, the last one first, as digits of its index.
    SweepMember member_of(std::size_t index, const SweepAxes &axes, const RunRequest &base)
    {
      const auto pick = [&index](const std::vector<double> &values, const double otherwise) {
        const double value = values.empty() ? otherwise : values[index % values.size()];
        index /= count(values);
        return value;
      };
      const bool  sinusoidal = is_sinusoidal(base.drive);
      SweepMember member;
      member.parameters                   = base.parameters;
      member.frequency_Hz                 = pick(axes.frequency_Hz, base.drive.frequency_Hz);
      member.by_T                         = pick(axes.by_T, sinusoidal ? base.drive.parameters[1] : 0.);
      member.bx_T                         = pick(axes.bx_T, sinusoidal ? base.drive.parameters[0] : 0.);
      member.parameters.magnetization_A_m = pick(axes.magnetization_A_m, base.parameters.magnetization_A_m);
      member.parameters.viscosity_Pa_s    = pick(axes.viscosity_Pa_s, base.parameters.viscosity_Pa_s);
      member.parameters.young_modulus_Pa  = pick(axes.young_modulus_Pa, base.parameters.young_modulus_Pa);
      return member;
    }

    RunRequest request_of(const SweepMember &member, const SweepOptions &options)
    {
      RunRequest request         = options.base;
      request.parameters         = member.parameters;
      request.drive.frequency_Hz = member.frequency_Hz;
      request.n_periods          = options.n_periods;
      request.samples_per_period = 0;
      if (is_sinusoidal(request.drive))
        request.drive.parameters = Eigen::Vector2d(member.bx_T, member.by_T);
      return request;
    }

    /// What the threads share: swimmers, which do not change.
    struct Swimmers
    {
      Swimmers(const ReducedModel &model, const InertialDensities &densities)
          : range(model.range), record(model.record), all(model, densities),
            fewer(truncated(model, n_modes_of_comparison(model.n_modes())), densities)
      {
        ReducedModel half = model;
        for (const Eigen::MatrixXd &coefficients : model.resistance.half_fits)
        {
          half.resistance.coefficients = coefficients;
          halves.emplace_back(half, densities);
        }
      }
      TrainedRange                range;
      TrainingRecord              record;
      ReducedSwimmer              all, fewer;
      std::vector<ReducedSwimmer> halves; ///< with the resistance of half of the samples
    };

    /// What each thread has for itself.
    class SweepWorker
    {
    public:
      SweepWorker(const Swimmers &swimmers, const SweepOptions &options)
          : swimmers_(swimmers), options_(options),
            all_(swimmers.all, {.relative_tolerance = options.relative_tolerance}),
            fewer_(swimmers.fewer, {.relative_tolerance = options.relative_tolerance}),
            orbits_(swimmers.all,
                    {.relative_tolerance = options.relative_tolerance, .closure = 10. * options.relative_tolerance})
      {
        halves_.reserve(swimmers.halves.size());
        for (const ReducedSwimmer &half : swimmers.halves)
          halves_.emplace_back(half, IntegratorOptions{.relative_tolerance = options.relative_tolerance});
      }

      SweepResult result_of(const SweepMember &member)
      {
        const double start = thread_cpu_time_s();
        SweepResult  result;
        result.member         = member;
        result.displacement_m = result.periodic_displacement_m = result.error_indicator_m = not_known;
        result.largest_multiplier = result.error_95_m = not_known;
        RunRequest request                            = request_of(member, options_);
        request.initial_state                         = starting_state(swimmers_.all, request.initial_state);
        const SwimmerRun run                          = all_.run(request);
        result.trust                                  = trust_notes(swimmers_.range, request, run);
        result.held_out_error                         = error_near(member);
        note_held_out_error(swimmers_.record, result.held_out_error, result.trust);
        result.note = run.failure;
        if (run.completed())
        {
          result.end            = run.at_period_end.back();
          result.displacement_m = displacement_per_period(run, options_.heading_rad).back();
          if (options_.indicator)
          {
            add_indicator(request, result);
            add_bound(request, result);
          }
          if (options_.periodic)
            add_orbit(request, result);
        }
        result.cpu_time_s = thread_cpu_time_s() - start;
        return result;
      }

    private:
      double error_near(const SweepMember &m) const
      {
        HeldOutRun like;
        like.young_modulus_Pa  = m.parameters.young_modulus_Pa;
        like.viscosity_Pa_s    = m.parameters.viscosity_Pa_s;
        like.magnetization_A_m = m.parameters.magnetization_A_m;
        like.frequency_Hz      = m.frequency_Hz;
        like.bx_T              = m.bx_T;
        like.by_T              = m.by_T;
        return error_nearby(swimmers_.record, like).value_or(not_known);
      }

      void add_indicator(RunRequest request, SweepResult &result)
      {
        if (swimmers_.fewer.n_modes() == swimmers_.all.n_modes())
          return; // nothing to compare with
        request.initial_state = starting_state(swimmers_.fewer, request.initial_state);
        const SwimmerRun run  = fewer_.run(request);
        if (run.completed())
          result.error_indicator_m = displacement_error_indicator(
              result.displacement_m, displacement_per_period(run, options_.heading_rad).back());
      }

      /// Half of what two independent halves differ by is the standard error of their mean.
      void add_bound(const RunRequest &request, SweepResult &result)
      {
        std::vector<double> displacements;
        for (SwimmerIntegrator &half : halves_)
          if (const SwimmerRun run = half.run(request); run.completed())
            displacements.push_back(displacement_per_period(run, options_.heading_rad).back());
        if (displacements.size() == 2)
          result.fit_change_m = .5 * std::abs(displacements[0] - displacements[1]);
        else if (!halves_.empty())
          return; // one of them fails: nothing is known
        result.error_95_m = error_bound_m(swimmers_.record, {result.displacement_m, result.fit_change_m});
        note_error_bound(swimmers_.record, result.error_95_m, result.displacement_m, result.trust);
      }

      void add_orbit(RunRequest request, SweepResult &result)
      {
        request.initial_state     = result.end;
        const PeriodicOrbit orbit = orbits_.find(request);
        if (!orbit.floquet_multipliers.empty())
          result.largest_multiplier = std::abs(orbit.floquet_multipliers.front());
        if (orbit.converged())
          result.periodic_displacement_m = orbit.displacement_m(options_.heading_rad);
        else
          result.note = orbit.failure;
      }

      const Swimmers                &swimmers_;
      const SweepOptions            &options_;
      SwimmerIntegrator              all_, fewer_;
      PeriodicOrbitFinder            orbits_;
      std::vector<SwimmerIntegrator> halves_;
    };
  } // namespace

  std::size_t SweepAxes::n_members() const
  {
    return count(young_modulus_Pa) * count(viscosity_Pa_s) * count(magnetization_A_m) * count(bx_T) * count(by_T) *
           count(frequency_Hz);
  }

  SweepOptions sweep_options(const Scene &scene, const ReducedModel &model)
  {
    SweepOptions options;
    options.base.parameters       = swimmer_parameters(scene);
    options.base.drive            = make_drive(scene.field);
    options.base.initial_state    = SwimmerState::Zero(model.n_modes() + 3);
    options.base.initial_state[2] = scene.head.angle_rad;
    options.heading_rad           = scene.head.angle_rad;
    return options;
  }

  std::vector<SweepResult> sweep(const ReducedModel &model, const SweepAxes &axes, const SweepOptions &options)
  {
    if (!is_sinusoidal(options.base.drive) && !(axes.bx_T.empty() && axes.by_T.empty()))
      throw InputError("bx and by can be swept for the sinusoidal field only, and this scene plays a field program.");
    const Swimmers           swimmers(model, options.densities);
    std::vector<SweepResult> results(axes.n_members());
    std::mutex               reporting;
    std::size_t              n_done = 0;
    parallel_for(results.size(), n_sweep_threads(options, results.size()), [&] {
      return [&, worker = SweepWorker(swimmers, options)](const std::size_t i) mutable {
        results[i] = worker.result_of(member_of(i, axes, options.base));
        const std::lock_guard lock(reporting);
        ++n_done;
        if (options.on_progress)
          options.on_progress(n_done);
      };
    });
    return results;
  }

  int n_sweep_threads(const SweepOptions &options, const std::size_t n_members)
  {
    return n_threads_for(n_members, options.n_threads);
  }
} // namespace swimtwin
