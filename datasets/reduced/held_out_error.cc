#include <datasets/reduced/held_out_error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    /// What the signs let expect, up to a factor that held-out runs tell.
    double expected_size_m(const TrainingRecord &record, const ErrorSigns &signs)
    {
      constexpr double without_signs = 0.005; // of a displacement: what no other model shows
      return std::hypot(without_signs * error_scale_m(record, signs.displacement_m), signs.fit_change_m);
    }

    /// Of Student's distribution, 97.5 %: from four degrees of freedom on the expansion about the normal one, to 0.3 %.
    double student_quantile(const int n)
    {
      constexpr std::array few{12.706, 4.303, 3.182};
      if (n <= static_cast<int>(few.size()))
        return few.at(static_cast<std::size_t>(n - 1));
      constexpr double z = 1.959964, z2 = z * z;
      const double     v = 1. / n;
      return z * (1. + v * ((z2 + 1.) / 4. + v * (((5. * z2 + 16.) * z2 + 3.) / 96. +
                                                  v * (((3. * z2 + 19.) * z2 + 17.) * z2 - 15.) / 384.)));
    }
  } // namespace

  ErrorSigns error_signs(const HeldOutRun &run)
  {
    return {run.reduced_displacement_m, run.fit_change_m};
  }

  double error_bound_m(const TrainingRecord &record, const ErrorSigns &signs)
  {
    const auto n = static_cast<int>(record.held_out_runs.size());
    if (n == 0)
      return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.;
    for (const HeldOutRun &run : record.held_out_runs)
      sum += std::pow((run.reduced_displacement_m - run.displacement_m) / expected_size_m(record, error_signs(run)), 2);
    return student_quantile(n) * std::sqrt(sum / n) * expected_size_m(record, signs);
  }

  double left_out_bound_m(const TrainingRecord &record, const std::size_t run)
  {
    TrainingRecord others;
    others.held_out_runs = record.held_out_runs;
    others.held_out_runs.erase(others.held_out_runs.begin() + static_cast<std::ptrdiff_t>(run));
    return error_bound_m(others, error_signs(record.held_out_runs[run]));
  }

  double error_scale_m(const TrainingRecord &record, const double displacement_m)
  {
    double largest = 0.;
    for (const HeldOutRun &run : record.held_out_runs)
      largest = std::max(largest, std::abs(run.displacement_m));
    return std::max(std::abs(displacement_m), .05 * largest);
  }

  double relative_error(const HeldOutRun &run, const TrainingRecord &record)
  {
    return std::abs(run.reduced_displacement_m - run.displacement_m) / error_scale_m(record, run.displacement_m);
  }

  HeldOutError displacement_error(const TrainingRecord &record)
  {
    HeldOutError error;
    for (const HeldOutRun &run : record.held_out_runs)
    {
      const double e = relative_error(run, record);
      error.worst    = std::max(error.worst, e);
      error.rms += e * e;
    }
    error.n_runs = static_cast<int>(record.held_out_runs.size());
    error.rms    = std::sqrt(error.rms / std::max(1, error.n_runs));
    return error;
  }

  std::string HeldOutError::text() const
  {
    return fmt::format("{:.2g} % (rms), {:.2g} % (worst) in {} full-order runs not trained on", 100. * rms,
                       100. * worst, n_runs);
  }

  double target_of(const TrainingRecord &record)
  {
    return record.target > 0. ? record.target : usual_target;
  }

  std::string missed_target(const TrainingRecord &record)
  {
    const HeldOutError error  = displacement_error(record);
    const double       target = target_of(record);
    if (!error.is_known() || error.is_within(target))
      return {};
    return fmt::format("the reduced model misses its target: displacements are off by {}, and {:.3g} % (rms; twice as "
                       "much at worst) was aimed at",
                       error.text(), 100. * target);
  }

  RunGroups run_groups(const HeldOutRun &p)
  {
    constexpr double nothing = 1e-300;
    const double     rate    = p.viscosity_Pa_s * p.frequency_Hz;
    return {std::log(p.young_modulus_Pa / rate),
            std::log(std::max(nothing, std::abs(p.magnetization_A_m) * std::hypot(p.bx_T, p.by_T) / rate)),
            std::atan2(std::abs(p.by_T), p.bx_T)};
  }

  std::optional<double> error_nearby(const TrainingRecord &record, const HeldOutRun &parameters)
  {
    constexpr double reach = 0.7, weight_of_all = 0.1; // log 2; what a run at 2 reaches has
    const RunGroups  own = run_groups(parameters);
    double           sum = weight_of_all * std::pow(displacement_error(record).rms, 2), weights = weight_of_all;
    for (const HeldOutRun &run : record.held_out_runs)
    {
      const RunGroups other = run_groups(run);
      const double    distance =
          std::hypot(own.elastic - other.elastic, own.magnetic - other.magnetic, own.slope - other.slope) / reach;
      const double weight = std::exp(-.5 * distance * distance);
      sum += weight * std::pow(relative_error(run, record), 2);
      weights += weight;
    }
    if (record.held_out_runs.empty())
      return {};
    return std::sqrt(sum / weights);
  }
} // namespace swimtwin
