#include <rom/integration/phase_integrator.h>
#include <rom/integration/swimmer_integrator.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    double unwrap(const double angle, const double previous)
    {
      return angle + 2. * std::numbers::pi * std::round((previous - angle) / (2. * std::numbers::pi));
    }

    /// Follows one run and keeps what it is asked for.
    class RunRecorder
    {
    public:
      RunRecorder(PhaseIntegrator &integrator, const RunRequest &request)
          : integrator_(integrator), request_(request), kinks_(request.drive.field->kinks())
      {
      }

      SwimmerRun record()
      {
        integrator_.start(request_);
        keep_state();
        watch_trust();
        if (request_.samples_per_period > 0)
          add_row(0.);
        run_.status = RunStatus::completed;
        for (int period = 1; period <= request_.n_periods && run_.completed(); ++period)
          record_period(period);
        count();
        return std::move(run_);
      }

    private:
      void record_period(const double end)
      {
        while (integrator_.phase() < end)
        {
          if (!integrator_.advance_one_step(next_stop(end)))
            return fail();
          watch_trust();
          take_samples();
        }
        keep_state();
        keep_work();
      }

      void fail()
      {
        run_.status  = RunStatus::failed;
        run_.failure = fmt::format("the reduced swimmer stopped {:.4g} periods after its start: {}",
                                   integrator_.phase(), integrator_.failure());
      }

      /// The period's end, or the next kink of the field before it.
      double next_stop(const double period_end) const
      {
        constexpr double round_off = 1e-12;
        for (const double kink : kinks_)
          if (const double stop = period_end - 1. + kink;
              stop > integrator_.phase() + round_off && stop < period_end - round_off)
            return stop;
        return period_end;
      }

      void take_samples()
      {
        const int n = request_.samples_per_period;
        for (auto i = static_cast<long>(run_.trajectory.size());
             n > 0 && i <= std::lround(std::floor(integrator_.phase() * n)); ++i)
          add_row(static_cast<double>(i) / n);
      }

      void add_row(const double phase)
      {
        PhaseEquations       &equations = integrator_.equations();
        const ReducedSwimmer &swimmer   = equations.swimmer();
        const Eigen::VectorXd state     = integrator_.state_at(phase);
        const ShapeVector     q         = state.segment(3, swimmer.n_modes());
        const Eigen::Vector2d tip       = state.head<2>() + Eigen::Rotation2Dd(state[2]) * swimmer.tip().position_m(q);
        const Eigen::Vector2d b         = equations.field_T(phase);
        const SwimmerMotion  &motion    = equations.motion(phase, state);
        TrajectoryRow         row;
        row.time_s             = phase / request_.drive.frequency_Hz;
        row.head_x_m           = state[0];
        row.head_y_m           = state[1];
        row.head_angle_rad     = state[2];
        row.head_qw            = std::cos(state[2] / 2.);
        row.head_qz            = std::sin(state[2] / 2.);
        row.tail_tip_x_m       = tip.x();
        row.tail_tip_y_m       = tip.y();
        row.tail_angle_rad     = unwrap(state[2] + swimmer.tip().angle_rad(q),
                                    run_.trajectory.empty() ? state[2] : run_.trajectory.back().tail_angle_rad);
        row.bx_T               = b.x();
        row.by_T               = b.y();
        row.magnetic_power_W_m = motion.magnetic_power_W_m;
        row.dissipation_W_m    = motion.dissipation_W_m;
        row.elastic_energy_J_m = equations.elastic_energy_J_m(state);
        row.n_unknowns         = swimmer.n_states();
        run_.trajectory.push_back(row);
        run_.snapshots.push_back({phase, state, motion.rate});
        if (equations.n_parameters() > 0)
          run_.sensitivity_at_snapshots.push_back(integrator_.sensitivities_at(phase));
      }

      void keep_state()
      {
        run_.at_period_end.emplace_back(integrator_.state());
        if (integrator_.equations().n_parameters() > 0)
          run_.sensitivity_at_period_end.push_back(integrator_.sensitivities());
      }

      void keep_work()
      {
        if (!integrator_.with_work())
          return;
        const Eigen::Vector2d so_far = integrator_.work(), added = so_far - work_before_;
        const PhaseEquations &equations = integrator_.equations();
        run_.work.push_back({added[0], added[1],
                             equations.elastic_energy_J_m(run_.at_period_end.back()) -
                                 equations.elastic_energy_J_m(*(run_.at_period_end.end() - 2)),
                             equations.kinetic_energy_J_m(run_.at_period_end.back()) -
                                 equations.kinetic_energy_J_m(*(run_.at_period_end.end() - 2))});
        work_before_ = so_far;
      }

      void watch_trust()
      {
        const ReducedSwimmer      &swimmer    = integrator_.equations().swimmer();
        const ResistanceSurrogate &resistance = swimmer.resistance();
        const auto                 state      = integrator_.state();
        run_.largest_shape_radius =
            std::max(run_.largest_shape_radius, resistance.shape_radius(state.segment(3, swimmer.n_modes())));
        run_.largest_angle_radius = std::max(run_.largest_angle_radius, resistance.angle_radius(state[2]));
        run_.largest_height_radius =
            std::max(run_.largest_height_radius,
                     resistance.height_radius(state.segment(3, swimmer.n_modes()), state[2], state[1]));
      }

      void count()
      {
        run_.n_steps            = integrator_.n_steps();
        run_.n_rate_evaluations = integrator_.equations().n_rate_evaluations;
        run_.n_jacobians        = integrator_.equations().n_jacobians;
      }

      PhaseIntegrator          &integrator_;
      const RunRequest         &request_;
      const std::vector<double> kinks_;
      Eigen::Vector2d           work_before_ = Eigen::Vector2d::Zero();
      SwimmerRun                run_;
    };
  } // namespace

  SwimmerIntegrator::SwimmerIntegrator(const ReducedSwimmer &swimmer, const IntegratorOptions &options)
      : integrator_(std::make_unique<PhaseIntegrator>(swimmer, options))
  {
  }

  SwimmerIntegrator::~SwimmerIntegrator()                             = default;
  SwimmerIntegrator::SwimmerIntegrator(SwimmerIntegrator &&) noexcept = default;

  SwimmerRun SwimmerIntegrator::run(const RunRequest &request)
  {
    return RunRecorder(*integrator_, request).record();
  }
} // namespace swimtwin
