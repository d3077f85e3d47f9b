#include <datasets/text/unit_names.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace swimtwin
{
  namespace
  {
    /// What a unit measures, and its size in SI units.
    struct Unit
    {
      std::string dimension;
      double      size = 0.;
    };

    struct NamedUnit
    {
      std::string_view name, dimension;
      double           size;
    };

    constexpr double degree_rad = std::numbers::pi / 180., per_turn = 0.5 / std::numbers::pi, minute_s = 60.;

    // Exactly as they stand, without prefixes.
    constexpr std::array<NamedUnit, 14> plain_symbols{{{"min", "time", minute_s},
                                                       {"h", "time", 60. * minute_s},
                                                       {"hz", "frequency", 1.},
                                                       {"rad_s", "frequency", per_turn},
                                                       {"rpm", "frequency", 1. / minute_s},
                                                       {"1_s", "frequency", 1.},
                                                       {"1_min", "frequency", 1. / minute_s},
                                                       {"deg", "angle", degree_rad},
                                                       {"in", "length", 0.0254},
                                                       {"Gs", "field", 1e-4},
                                                       {"cP", "viscosity", 1e-3},
                                                       {"m3", "volume", 1.},
                                                       {"cm3", "volume", 1e-6},
                                                       {"mm3", "volume", 1e-9}}};
    constexpr std::array<NamedUnit, 12> symbols{{{"m", "length", 1.},
                                                 {"s", "time", 1.},
                                                 {"Hz", "frequency", 1.},
                                                 {"rad", "angle", 1.},
                                                 {"T", "field", 1.},
                                                 {"G", "field", 1e-4},
                                                 {"Pa", "pressure", 1.},
                                                 {"Pa_s", "viscosity", 1.},
                                                 {"P", "viscosity", 0.1},
                                                 {"A", "current", 1.},
                                                 {"g", "mass", 1e-3},
                                                 {"N", "force", 1.}}};
    constexpr std::array<NamedUnit, 15> words{{{"meter", "length", 1.},
                                               {"metre", "length", 1.},
                                               {"micron", "length", 1e-6},
                                               {"inch", "length", 0.0254},
                                               {"inche", "length", 0.0254}, // of the plural
                                               {"sec", "time", 1.},
                                               {"second", "time", 1.},
                                               {"minute", "time", minute_s},
                                               {"hour", "time", 60. * minute_s},
                                               {"hertz", "frequency", 1.},
                                               {"degree", "angle", degree_rad},
                                               {"radian", "angle", 1.},
                                               {"tesla", "field", 1.},
                                               {"gauss", "field", 1e-4},
                                               {"pascal", "pressure", 1.}}};

    using Prefix = std::pair<std::string_view, double>;
    constexpr std::array<Prefix, 8> prefixes{
        {{"n", 1e-9}, {"u", 1e-6}, {"m", 1e-3}, {"c", 1e-2}, {"d", 1e-1}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}}};
    constexpr std::array<Prefix, 9> word_prefixes{{{"nano", 1e-9},
                                                   {"micro", 1e-6},
                                                   {"milli", 1e-3},
                                                   {"centi", 1e-2},
                                                   {"kilo", 1e3},
                                                   {"mega", 1e6},
                                                   {"giga", 1e9},
                                                   {"m", 1e-3},   // msec
                                                   {"u", 1e-6}}}; // usec

    using boost::algorithm::replace_all;

    std::string lower_case(const std::string_view text)
    {
      return boost::algorithm::to_lower_copy(std::string(text));
    }

    /// In lower case, with `_` for blanks.
    std::string stem_of(const std::string_view text)
    {
      std::string word = lower_case(text.substr(0, text.find_last_not_of(" _") + 1));
      std::replace(word.begin(), word.end(), ' ', '_');
      return word;
    }

    /// One spelling for all: `µm / s` -> `um_s`.
    std::string plain_spelling(const std::string_view unit)
    {
      std::string text(without_brackets(unit));
      replace_all(text, "\u00B5", "u"); // micro sign
      replace_all(text, "\u03BC", "u"); // Greek mu
      replace_all(text, "\u00B0", "deg");
      replace_all(text, "\u00B7", "_");
      replace_all(text, "\u00B3", "3");
      replace_all(text, "_per_", "_");
      replace_all(text, " per ", "_");
      std::replace_if(
          text.begin(), text.end(), [](const char c) { return c == '/' || c == '*' || c == ' '; }, '_');
      while (text.find("__") != std::string::npos)
        replace_all(text, "__", "_");
      std::erase(text, '^');
      return text;
    }

    template <std::size_t n>
    std::optional<Unit> find(const std::array<NamedUnit, n> &list, const std::string_view name,
                             const double prefix = 1.)
    {
      const auto found =
          std::find_if(list.begin(), list.end(), [&](const NamedUnit &unit) { return unit.name == name; });
      return found == list.end() ? std::nullopt
                                 : std::optional(Unit{std::string(found->dimension), prefix * found->size});
    }

    template <std::size_t n, std::size_t m>
    std::optional<Unit> find_prefixed(const std::array<NamedUnit, n> &list, const std::array<Prefix, m> &with,
                                      const std::string_view name)
    {
      if (const auto unit = find(list, name))
        return unit;
      for (const auto &[prefix, size] : with)
        if (name.starts_with(prefix))
          if (const auto unit = find(list, name.substr(prefix.size()), size))
            return unit;
      return std::nullopt;
    }

    std::optional<Unit> find_word(const std::string_view name)
    {
      std::string word = lower_case(name);
      if (const auto unit = find_prefixed(words, word_prefixes, word))
        return unit;
      if (word.ends_with('s'))
        word.pop_back();
      return find_prefixed(words, word_prefixes, word);
    }

    /// `name` in the spelling of `plain_spelling`.
    std::optional<Unit> parse_unit(const std::string_view name)
    {
      if (const auto unit = find(plain_symbols, name))
        return unit;
      if (const auto unit = find_prefixed(symbols, prefixes, name))
        return unit;
      if (const auto unit = find_word(name))
        return unit;
      const auto slash = name.find('_');
      if (slash == std::string_view::npos)
        return std::nullopt;
      const auto above = parse_unit(name.substr(0, slash)), below = parse_unit(name.substr(slash + 1));
      if (!above || !below)
        return std::nullopt;
      return Unit{above->dimension + " per " + below->dimension, above->size / below->size};
    }
  } // namespace

  std::string_view without_brackets(const std::string_view unit)
  {
    const bool inside = unit.size() >= 2 &&
                        ((unit.front() == '(' && unit.back() == ')') || (unit.front() == '[' && unit.back() == ']'));
    return inside ? unit.substr(1, unit.size() - 2) : unit;
  }

  std::optional<double> unit_factor(const std::string_view from, const std::string_view to)
  {
    const auto a = parse_unit(plain_spelling(from)), b = parse_unit(plain_spelling(to));
    return a && b && a->dimension == b->dimension ? std::optional(a->size / b->size) : std::nullopt;
  }

  std::optional<std::string> repaired_unit(const std::string_view unit)
  {
    std::string text(without_brackets(unit));
    for (const char *micro : {"\\u00B5", "\\u00b5", "\\u03BC", "\\u03bc", "&micro;", "&mu;"})
      replace_all(text, micro, "?");
    const auto  is_sound = [](const char c) { return static_cast<unsigned char>(c) < 0x80 && c != '?'; };
    const auto  sound    = std::find_if(text.begin(), text.end(), is_sound);
    std::string repaired = "u" + std::string(sound, text.end());
    if (sound == text.begin() || unit_factor(unit, unit) || !unit_factor(repaired, repaired))
      return std::nullopt;
    return repaired;
  }

  bool is_pixel(const std::string_view unit)
  {
    const std::string name = lower_case(without_brackets(unit));
    return name == "pixel" || name == "pixels" || name == "px" || name == "pix";
  }

  NameWithUnit split_brackets(const std::string_view name)
  {
    const auto open = name.find_last_of("([");
    if (open == std::string_view::npos || open == 0 || (name.back() != ')' && name.back() != ']'))
      return {stem_of(name), ""};
    return {stem_of(name.substr(0, open)), std::string(without_brackets(name.substr(open)))};
  }

  std::vector<NameWithUnit> readings_of(const std::string_view name)
  {
    std::vector<NameWithUnit> readings{{stem_of(name), ""}};
    if (NameWithUnit bracketed = split_brackets(name); !bracketed.unit.empty())
      readings.push_back(std::move(bracketed));
    for (auto at = name.find('_'); at != std::string_view::npos; at = name.find('_', at + 1))
      if (at > 0 && at + 1 < name.size())
        readings.push_back({stem_of(name.substr(0, at)), std::string(name.substr(at + 1))});
    return readings;
  }

  std::optional<NameWithUnit> reading_with_unit(const std::string_view name)
  {
    for (NameWithUnit &reading : readings_of(name))
      if (!reading.unit.empty() && unit_factor(reading.unit, reading.unit))
        return std::move(reading);
    return std::nullopt;
  }

  std::string name_in_unit(const std::string_view name, const std::string_view unit)
  {
    const std::optional<NameWithUnit> reading = reading_with_unit(name);
    return (reading ? reading->stem : stem_of(name)) + "_" + plain_spelling(unit);
  }

  std::optional<double> factor_between_names(const std::string_view name, const std::string_view wanted)
  {
    if (stem_of(name) == stem_of(wanted))
      return 1.; // but for capital letters
    for (const NameWithUnit &of_wanted : readings_of(wanted))
      for (const NameWithUnit &of_name : readings_of(name))
        if (!of_wanted.unit.empty() && of_name.stem == of_wanted.stem)
          if (const std::optional<double> factor = unit_factor(of_name.unit, of_wanted.unit))
            return factor;
    return std::nullopt;
  }
} // namespace swimtwin
