// How people read the parameters of a fit: symbol, unit, and a power of ten that keeps numbers short.
#pragma once

#include <datasets/observation/calibration_result.h>

#include <string>

namespace swimtwin
{
  struct ShownQuantity
  {
    std::string symbol;      ///< "E/μ"
    std::string unit;        ///< "kPa", "10³/s"; empty for a pure number
    double      factor = 1.; ///< shown = value x factor

    /// "E/μ (10³/s)"
    std::string label() const;
  };

  /// For numbers of the size of `value`. A parameter that is not known keeps its name.
  ShownQuantity shown_quantity(const std::string &parameter, double value);

  /// "0.95" -> "95 %"
  std::string level_text(double level);

  /// "51.2 to 54.1", "above 51.2", "not bounded"; in the shown unit.
  std::string interval_text(const ClaimedInterval &interval, const ShownQuantity &shown);
} // namespace swimtwin
