#include <app/verbs/calibration_input.h>

#include <app/frame/shipped_files.h>
#include <datasets/system/error.h>
#include <reports/page/shown_units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// "2.1 to 3.4", or one number if both would be printed alike.
    template <typename Value>
    std::string range_of(const ObservationSet &set, const Value &value)
    {
      double low = value(set.points.front()), high = low;
      for (const Observation &point : set.points)
      {
        low  = std::min(low, value(point));
        high = std::max(high, value(point));
      }
      const std::string first = fmt::format("{:.3g}", low), last = fmt::format("{:.3g}", high);
      return first == last ? first : first + " to " + last;
    }

    std::string field_text(const FieldProgram &field)
    {
      if (field.waveform() == FieldProgram::Waveform::sinusoidal)
        return fmt::format("bx {:.4g} mT, by {:.4g} mT sin", mT * field.bx_T(), mT * field.by_T());
      return fmt::format("a field program of {} samples", field.time_s().size());
    }

    std::string origin_text(const ObservationSet &set)
    {
      const bool from_tracks = set.quantity == ObservedQuantity::positions;
      return fmt::format("{}; {}{}", set.source, set.measured_by,
                         set.synthetic ? "; synthetic"
                         : from_tracks ? "; from tracks of the head"
                                       : "");
    }

    std::string summary(const ObservationSet &set, const double body_length_m)
    {
      const double length = set.body_length_m.value_or(body_length_m);
      const auto   of     = [&](const auto &value) { return range_of(set, value); };
      std::string  text   = fmt::format("  {}\n    {} observations at {} Hz, of {}\n", set.name, set.points.size(),
                                        of([](const Observation &p) { return p.frequency_Hz; }),
                                     set.period ? fmt::format("period {} after a start from rest", *set.period)
                                                   : "the periodic motion");
      text += fmt::format("    displacement   {} mm per period, {} body lengths of {:.3g} mm\n",
                          of([](const Observation &p) { return mm * p.displacement_m; }),
                          of([&](const Observation &p) { return p.displacement_m / length; }), mm * length);
      text += fmt::format("    sigma          {} mm, {} % of the displacement\n",
                          of([](const Observation &p) { return mm * p.sigma_m; }),
                          of([](const Observation &p) { return 100. * p.sigma_m / std::abs(p.displacement_m); }));
      return text +
             fmt::format("    field          {}\n    origin         {}\n", field_text(set.field), origin_text(set));
    }

    void require_dimension(const CalibrationInput &input)
    {
      const int dimension = input.model.tail.dimension();
      for (const ObservationSet &set : input.sets)
        if (set.dimension.value_or(dimension) != dimension)
          throw InputError(fmt::format("{}: computed in {} dimensions, as its sidecar says, and the swimmer of {} has "
                                       "{}; estimates would make up for the difference: take a model of the data's "
                                       "dimension.",
                                       set.file.string(), *set.dimension, input.model.scene_name, dimension));
    }
  } // namespace

  CalibrationInput read_calibration_input(const CalibrateCommand &command)
  {
    CalibrationInput input{
        read_reduced_model(find_model(command.model)), read_calibration_problem(command.problem), {}};
    std::vector<std::filesystem::path> files(command.data.begin(), command.data.end());
    if (files.empty())
      files = input.problem.data;
    if (files.empty())
      throw InputError(fmt::format("{} names no data = [...] and no --data is given; give at least one CSV of "
                                   "observations.",
                                   command.problem));
    input.sets = read_observations(files);
    require_dimension(input);
    return input;
  }

  std::string summary(const CalibrationInput &input)
  {
    const double body_length_m = parse_scene(input.model.scene_text, input.model.scene_name + ".toml").body_length_m();
    std::string  text          = fmt::format("  model {}: free parameters and their bounds\n", input.model.scene_name);
    for (const FreeParameter &free : input.problem.free)
      text += fmt::format(
          "    {:<38} {:.4g} to {:.4g}{}\n", key_of(free.quantity), free.lower, free.upper,
          free.prior ? fmt::format(", prior {:.4g} +- {:.2g}", free.prior->mean, free.prior->standard_deviation) : "");
    for (const ObservationSet &set : input.sets)
      text += summary(set, body_length_m);
    return text;
  }
} // namespace swimtwin
