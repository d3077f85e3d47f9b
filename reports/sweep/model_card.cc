#include <reports/sweep/model_card.h>

#include <datasets/reduced/held_out_error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    std::string text_of(const Interval &interval, const char *unit)
    {
      return interval.low == interval.high ? fmt::format("{:.4g} {}", interval.low, unit)
                                           : fmt::format("{:.4g} to {:.4g} {}", interval.low, interval.high, unit);
    }

    std::string range_line(const TrainedRange &range)
    {
      return fmt::format("E {}, viscosity {}, magnetization {}, frequency {}, bx {}, by {}",
                         text_of(range.young_modulus_Pa, "Pa"), text_of(range.viscosity_Pa_s, "Pa s"),
                         text_of(range.magnetization_A_m, "A/m"), text_of(range.frequency_Hz, "Hz"),
                         text_of(range.bx_T, "T"), text_of(range.by_T, "T"));
    }

    std::string held_out_line(const TrainingRecord &record)
    {
      const HeldOutError error = displacement_error(record);
      return error.is_known() ? "displacement off by " + error.text()
                              : "no held-out runs: the displacement's error is not known";
    }

    /// Whether the bounds hold: for each run that which the others tell.
    std::string bound_line(const TrainingRecord &record)
    {
      const std::size_t n       = record.held_out_runs.size();
      double            largest = 0.;
      int               held    = 0;
      for (std::size_t i = 0; i < n; ++i)
      {
        const HeldOutRun &run = record.held_out_runs[i];
        largest =
            std::max(largest, error_bound_m(record, error_signs(run)) / error_scale_m(record, run.displacement_m));
        held += std::abs(run.reduced_displacement_m - run.displacement_m) <= left_out_bound_m(record, i);
      }
      return fmt::format("displacement within {:.2g} % with 95 % where these runs are least certain{}", 100. * largest,
                         n > 1 ? fmt::format("; {} of {} were within what the others told", held, n) : "");
    }

    /// How the error indicator compares with the true error, at best and at worst.
    std::string indicator_line(const std::vector<HeldOutRun> &runs)
    {
      double lowest = std::numeric_limits<double>::infinity(), highest = 0.;
      for (const HeldOutRun &run : runs)
        if (const double error = std::abs(run.reduced_displacement_m - run.displacement_m); error > 0.)
        {
          lowest  = std::min(lowest, run.indicator_m / error);
          highest = std::max(highest, run.indicator_m / error);
        }
      return fmt::format("the error indicator was {:.2g} to {:.2g} times the true error", lowest, highest);
    }
  } // namespace

  std::string model_card(const ReducedModel &model)
  {
    const TrainingRecord &record = model.record;
    std::string           text   = missed_target(record);
    if (!text.empty())
      text = fmt::format("MISSED: {}.\n", text);
    text += fmt::format("Reduced swimmer of {}: {} modes with {:.5g} % of the energy of {} snapshots\n",
                        model.scene_name, model.n_modes(), 100. * record.energy_captured, record.n_snapshots);
    text += fmt::format("  trained at   {}\n", range_line(model.range));
    text += fmt::format("  held out     {}\n", held_out_line(record));
    text += fmt::format(
        "               surface velocity off by {:.2g} % (rms), {:.2g} % (worst) at {} shapes not trained on\n",
        100. * record.velocity_error_rms, 100. * record.velocity_error_max, record.n_held_out_samples);
    if (!record.held_out_runs.empty())
      text += fmt::format("               {}\n               {}\n", bound_line(record),
                          indicator_line(record.held_out_runs));
    for (const std::string &step : record.history)
      text += fmt::format("  training     {}\n", step);
    if (model.inertia.is_given())
      text += "  inertia      of fluid, tail and head, carried where [fluid] inertia or --inertia asks for it (`twin` "
              "and `lab`: "
              "where it counts)\n";
    for (const std::string &neglected : record.neglects)
      text += fmt::format("  neglects     {}\n", neglected);
    return text;
  }
} // namespace swimtwin
