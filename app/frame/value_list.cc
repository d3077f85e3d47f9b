#include <app/frame/value_list.h>

#include <datasets/system/error.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int max_values = 1'000'000;

    std::vector<std::string> split(const std::string &text, const char separator)
    {
      std::vector<std::string> parts;
      for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1)
      {
        end = text.find(separator, start);
        parts.push_back(text.substr(start, end == std::string::npos ? end : end - start));
      }
      return parts;
    }

    /// Reads one option and remembers how to complain about it.
    class ValueReader
    {
    public:
      ValueReader(std::string option, std::string text, const ValueRule rule)
          : option_(std::move(option)), text_(std::move(text)), rule_(rule)
      {
      }

      std::vector<double> values() const
      {
        std::vector<double> all;
        for (const std::string &item : split(text_, ','))
          for (const double value : values_of(item))
            all.push_back(value);
        return all;
      }

    private:
      [[noreturn]] void refuse(const std::string &why) const
      {
        throw InputError(fmt::format("{} {}: {}", option_, text_.empty() ? "\"\"" : text_, why));
      }

      double number(const std::string &text) const
      {
        double     value     = 0.;
        const auto end       = text.data() + text.size();
        const auto [at, bad] = std::from_chars(text.data(), end, value);
        if (text.empty())
          refuse("a value is missing; give a number such as 0.8, a list 0.5,0.8 or a range 0.1:3:60.");
        if (bad != std::errc() || at != end || !std::isfinite(value))
          refuse(fmt::format("\"{}\" is not a number; write it as 0.8 or 5e4.", text));
        if (rule_ == ValueRule::positive && value <= 0.)
          refuse(fmt::format("{} is not positive; only values above 0 make sense here.", text));
        return value;
      }

      int n_values(const std::string &text) const
      {
        int        n         = 0;
        const auto end       = text.data() + text.size();
        const auto [at, bad] = std::from_chars(text.data(), end, n);
        if (bad != std::errc() || at != end)
          refuse(fmt::format("\"{}\" is not a whole number of values; write a range as low:high:number.", text));
        if (n < 2 || n > max_values)
          refuse(fmt::format(
              "a range of {} values is not possible; it needs at least 2, both ends among them, and at most "
              "{}.",
              n, max_values));
        return n;
      }

      std::vector<double> values_of(const std::string &item) const
      {
        const std::vector<std::string> parts = split(item, ':');
        if (parts.size() == 1)
          return {number(item)};
        const bool logarithmic = parts.size() == 4 && parts[3] == "log";
        if (parts.size() != 3 && !logarithmic)
          refuse(fmt::format("\"{}\" is not a range; write low:high:number or low:high:number:log.", item));
        const double low = number(parts[0]), high = number(parts[1]);
        if (high <= low)
          refuse(fmt::format("the range {} runs from {} to {}; give the lower end first.", item, parts[0], parts[1]));
        if (logarithmic && low <= 0.)
          refuse(fmt::format("the range {} has no logarithms at and below 0; start it above 0.", item));
        return spaced(low, high, n_values(parts[2]), logarithmic);
      }

      static std::vector<double> spaced(const double low, const double high, const int n, const bool logarithmic)
      {
        std::vector<double> values;
        for (int i = 0; i + 1 < n; ++i)
        {
          const double share = static_cast<double>(i) / (n - 1);
          values.push_back(logarithmic ? low * std::pow(high / low, share) : low + share * (high - low));
        }
        values.push_back(high);
        return values;
      }

      std::string option_, text_;
      ValueRule   rule_;
    };
  } // namespace

  std::vector<double> parse_values(const std::string &option, const std::string &text, const ValueRule rule)
  {
    return ValueReader(option, text, rule).values();
  }

  double parse_share(const std::string &option, const std::string &text)
  {
    const bool   in_percent = text.ends_with('%');
    const double value =
        parse_values(option, in_percent ? text.substr(0, text.size() - 1) : text, ValueRule::positive).front();
    const double     share   = in_percent ? value / 100. : value;
    constexpr double largest = .2;
    if (share > largest)
      throw InputError(
          fmt::format("{} {} is {:.3g} %, which is no agreement; choose {:g} % at most, such as 1% or 0.01.", option,
                      text, 100. * share, 100. * largest));
    return share;
  }
} // namespace swimtwin
