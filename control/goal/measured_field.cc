#include <control/goal/measured_field.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int fine_samples = 480; // ten times a search's
    constexpr int fine_field   = 4096;

    const FourierField &fourier(const Drive &drive)
    {
      return dynamic_cast<const FourierField &>(*drive.field);
    }

    void describe_field(const FieldTask &task, const Drive &drive, PlannedField &field)
    {
      const auto &series = fourier(drive).series();
      const int   n      = series.n_coefficients() / 2;
      field.bx_T.assign(drive.parameters.begin(), drive.parameters.begin() + n);
      field.by_T.assign(drive.parameters.begin() + n, drive.parameters.end());
      field.frequency_Hz = drive.frequency_Hz;
      for (int i = 0; i < fine_field; ++i)
      {
        const double phase    = static_cast<double>(i) / fine_field;
        field.largest_field_T = std::max(field.largest_field_T, series.value(phase, drive.parameters).norm());
        field.largest_slew_T_s =
            std::max(field.largest_slew_T_s, drive.frequency_Hz * series.rate(phase, drive.parameters).norm());
      }
      const LimitedField limits(fourier(drive), task.goal.field);
      // of squares, as the search sees them
      field.field_excess = std::sqrt(1. + limits.largest_of(fine_field, drive.parameters, drive.frequency_Hz)) - 1.;
    }

    void describe_motion(const FieldTask &task, const StrokeProblem &problem, const Stroke &stroke, PlannedField &field)
    {
      const double heading = task.goal.heading_rad;
      field.moves          = true;
      field.displacement_m = stroke.orbit.displacement_m(heading);
      field.mean_speed_m_s = field.displacement_m * field.frequency_Hz;
      field.sideways_m     = Eigen::Vector2d(-std::sin(heading), std::cos(heading)).dot(stroke.orbit.drift_m);
      for (const std::complex<double> &multiplier : stroke.orbit.floquet_multipliers)
        field.multipliers.push_back(std::abs(multiplier));
      field.objective = 0.;
      for (const StrokeTerm term : all_stroke_terms)
        field.terms[to_string(term)] = problem.term(term, stroke).value;
      for (const auto &[term, weight] : task.goal.weights)
        if (const auto size = task.sizes.find(term); size != task.sizes.end())
          field.objective += (is_gain(term) ? -weight : weight) * field.terms[to_string(term)] / size->second;
      const LimitedMotion &limits         = problem.motion_limits();
      field.largest_shape_radius          = limits.largest_shape_radius(stroke);
      field.largest_strain                = limits.largest_strain(stroke);
      field.largest_heading_deviation_rad = limits.largest_heading_deviation_rad(stroke);
      field.motion_excess                 = limits.largest_of(stroke);
      const SwimmerState &start           = stroke.orbit.start;
      field.start.assign(start.begin() + 2, start.end());
    }
  } // namespace

  PlannedField measured_field(const std::string &name, const FieldTask &task, const Drive &drive,
                              const SwimmerState &start)
  {
    PlannedField field;
    field.name   = name;
    field.status = "given";
    describe_field(task, drive, field);
    const FieldVariables variables(fourier(drive).series().n_harmonics(), FieldFamily::general);
    StrokeProblem        problem(task.model, task.swimmer, task.goal, variables,
                                 {.relative_tolerance = 1e-8, .closure = 1e-7, .n_samples = fine_samples});
    problem.restart_from(start);
    const Stroke &stroke = problem.stroke(variables.variables(drive.parameters, drive.frequency_Hz), false);
    field.message        = stroke.failure;
    if (stroke.found())
      describe_motion(task, problem, stroke, field);
    return field;
  }

  PlannedField measured_field(const std::string &name, const FieldTask &task, const std::vector<FieldFound> &found)
  {
    const FieldFound &best = best_of(found);
    PlannedField      field;
    if (best.minimum.x.size() > 0)
      field = measured_field(name, task, best.drive, best.start);
    field.name         = name;
    field.status       = to_string(best.minimum.status);
    field.message      = best.minimum.message;
    field.kkt_residual = best.minimum.kkt_residual;
    field.trace        = best.trace;
    field.n_starts     = static_cast<int>(found.size());
    for (const FieldFound &one : found)
    {
      field.n_evaluations += one.minimum.n_evaluations;
      field.n_gradients += one.minimum.n_gradients;
      field.n_periods += one.n_periods;
    }
    return field;
  }

  Drive drive_of(const PlannedField &field)
  {
    const int n     = static_cast<int>(field.bx_T.size());
    Drive     drive = {std::make_shared<FourierField>((n - 1) / 2), Eigen::VectorXd(2 * n), field.frequency_Hz};
    for (int i = 0; i < n; ++i)
    {
      drive.parameters[i]     = field.bx_T[static_cast<std::size_t>(i)];
      drive.parameters[n + i] = field.by_T[static_cast<std::size_t>(i)];
    }
    return drive;
  }

  SwimmerState start_of(const PlannedField &field)
  {
    SwimmerState state = SwimmerState::Zero(static_cast<Eigen::Index>(field.start.size()) + 2);
    for (std::size_t i = 0; i < field.start.size(); ++i)
      state[static_cast<Eigen::Index>(i) + 2] = field.start[i];
    return state;
  }

  FieldProgram sampled_program(const Drive &drive, const double sample_rate_Hz)
  {
    constexpr long                     n_min    = 16;
    const double                       period_s = 1. / drive.frequency_Hz;
    const long                         n        = std::max(n_min, std::lround(sample_rate_Hz * period_s));
    std::vector<double>                time_s;
    std::vector<std::array<double, 3>> b_T;
    for (long i = 0; i < n; ++i)
    {
      const double          phase = static_cast<double>(i) / static_cast<double>(n);
      const Eigen::Vector2d b     = drive.field->value_T(phase, drive.parameters);
      time_s.push_back(phase * period_s);
      b_T.push_back({b.x(), b.y(), 0.});
    }
    return FieldProgram::sampled(std::move(time_s), std::move(b_T), period_s);
  }
} // namespace swimtwin
