#include <rom/sweep/trained_ratios.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace swimtwin
{
  namespace
  {
    constexpr double   round_off = 1e-7;
    constexpr double   unbounded = std::numeric_limits<double>::infinity();
    constexpr Interval one       = {1., 1.};

    void compare(const char *name, const double value, const Interval &range, std::vector<std::string> &notes)
    {
      const double slack = round_off * std::max(std::abs(range.low), std::abs(range.high));
      if (value < range.low - slack)
        notes.push_back(fmt::format("{} = {:.4g} below {:.4g}", name, value, range.low));
      if (value > range.high + slack)
        notes.push_back(fmt::format("{} = {:.4g} above {:.4g}", name, value, range.high));
    }

    /// What the value may be multiplied by, by a positive factor, to lie in the range; nothing if it never does.
    std::optional<Interval> factors_into(const Interval &range, const double value)
    {
      if (value < 0.)
        return factors_into({-range.high, -range.low}, -value);
      if (value == 0.)
        return range.contains(0.) ? std::optional(Interval{0., unbounded}) : std::nullopt;
      if (range.high <= 0.)
        return std::nullopt;
      return Interval{std::max(range.low, 0.) / value * (1. - round_off), range.high / value * (1. + round_off)};
    }

    /// A quantity of the run and the factors that take it to where the model was trained.
    struct ScaledQuantity
    {
      std::string name;
      double      value = 0.;
      Interval    factors;
    };

    /// Notes on ratios: a common factor takes all quantities to where the model was trained if and only if it does so
    /// for every two of them (intervals that meet in pairs have a point in common).
    void compare_ratios(const std::vector<ScaledQuantity> &quantities, std::vector<std::string> &notes)
    {
      const auto over = [](const std::string &name) {
        return name == "1" ? "" : name.find(' ') == std::string::npos ? "/" + name : "/(" + name + ")";
      };
      for (std::size_t i = 0; i < quantities.size(); ++i)
        for (std::size_t j = i + 1; j < quantities.size(); ++j)
        {
          const ScaledQuantity &a = quantities[i], &b = quantities[j];
          const std::string     name  = a.name + over(b.name);
          const double          ratio = a.value / b.value;
          if (a.factors.low > b.factors.high)
            notes.push_back(
                fmt::format("{} = {:.4g} below {:.4g}", name, ratio, ratio * a.factors.low / b.factors.high));
          if (a.factors.high < b.factors.low)
            notes.push_back(
                fmt::format("{} = {:.4g} above {:.4g}", name, ratio, ratio * a.factors.high / b.factors.low));
        }
    }

    /// The quantity; if no factor helps, a note under its full name instead.
    void add(const char *name, const char *key, const double value, const Interval &range,
             std::vector<ScaledQuantity> &quantities, std::vector<std::string> &notes)
    {
      if (const auto factors = factors_into(range, value))
        quantities.push_back({name, value, *factors});
      else
        compare(key, value, range, notes);
    }

    bool is_reference_sinusoid(const Drive &drive)
    {
      return dynamic_cast<const SinusoidalField *>(drive.field.get()) != nullptr;
    }

    /// bx and by of the reference sinusoid; of other fields nothing.
    std::vector<ScaledQuantity> field_quantities(const TrainedRange &range, const Drive &drive,
                                                 std::vector<std::string> &notes)
    {
      std::vector<ScaledQuantity> field;
      if (is_reference_sinusoid(drive))
      {
        add("bx", "bx_T", drive.parameters[0], range.bx_T, field, notes);
        add("by", "by_T", drive.parameters[1], range.by_T, field, notes);
      }
      return field;
    }

    /// The head's magnetization times the field: the trained ranges of both are at hand.
    ScaledQuantity moment_in_field(const ScaledQuantity &magnetization, const std::vector<ScaledQuantity> &field)
    {
      if (field.empty())
        return magnetization;
      Interval common = field.front().factors;
      for (const ScaledQuantity &component : field)
        common = {std::max(common.low, component.factors.low), std::min(common.high, component.factors.high)};
      if (common.low > common.high) // of another direction, which is noted: compare sizes by the last component
        common = field.back().factors;
      const ScaledQuantity &named = field.back().value != 0. ? field.back() : field.front();
      return {magnetization.name + " " + named.name,
              magnetization.value * named.value,
              {magnetization.factors.low * common.low, magnetization.factors.high * common.high}};
    }

    void compare_groups(const TrainedRange &range, const RunRequest &request, std::vector<std::string> &notes)
    {
      const SwimmerParameters          &p     = request.parameters;
      const double                      f     = request.drive.frequency_Hz;
      const Interval                    mu_f  = {range.viscosity_Pa_s.low * range.frequency_Hz.low,
                                                 range.viscosity_Pa_s.high * range.frequency_Hz.high};
      const std::vector<ScaledQuantity> field = field_quantities(range, request.drive, notes);
      std::vector<ScaledQuantity>       forces, magnetization;
      add("E", "young_modulus_Pa", p.young_modulus_Pa, range.young_modulus_Pa, forces, notes);
      add("M", "magnetization_A_m", p.magnetization_A_m, range.magnetization_A_m, magnetization, notes);
      if (p.tail_magnetization_A_m != 0.) // head and tail are magnetised as they were: the field scales by itself
      {
        magnetization.push_back({"1", 1., one});
        compare_ratios(magnetization, notes);
        forces.insert(forces.end(), field.begin(), field.end());
        if (field.empty())
          forces.push_back(magnetization.back());
      }
      else
      {
        compare_ratios(field, notes);
        if (!magnetization.empty())
          forces.push_back(moment_in_field(magnetization.front(), field));
      }
      add("mu f", "viscosity_Pa_s x frequency_Hz", p.viscosity_Pa_s * f, mu_f, forces, notes);
      compare_ratios(forces, notes);
    }

  } // namespace

  std::vector<std::string> parameters_outside_range(const TrainedRange &range, const RunRequest &request)
  {
    std::vector<std::string> notes;
    const SwimmerParameters &p = request.parameters;
    compare("young_modulus_Pa", p.young_modulus_Pa, range.young_modulus_Pa, notes);
    compare("viscosity_Pa_s", p.viscosity_Pa_s, range.viscosity_Pa_s, notes);
    compare("magnetization_A_m", p.magnetization_A_m, range.magnetization_A_m, notes);
    compare("frequency_Hz", request.drive.frequency_Hz, range.frequency_Hz, notes);
    if (is_reference_sinusoid(request.drive))
    {
      compare("bx_T", request.drive.parameters[0], range.bx_T, notes);
      compare("by_T", request.drive.parameters[1], range.by_T, notes);
    }
    return notes;
  }

  std::vector<std::string> notes_outside_range(const TrainedRange &range, const RunRequest &request)
  {
    std::vector<std::string> notes;
    compare_groups(range, request, notes);
    if (!notes.empty())
      for (const std::string &note : parameters_outside_range(range, request))
        if (std::find(notes.begin(), notes.end(), note) == notes.end())
          notes.push_back(note);
    return notes;
  }
} // namespace swimtwin
