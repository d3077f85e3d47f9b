#include <twin/telling/carrier_change.h>

#include <algorithm>

namespace swimtwin
{
  Drive changed(const Drive &drive, const FieldChange &change)
  {
    Drive      result = drive;
    const auto names  = drive.field->parameter_names();
    for (std::size_t i = 0; i < names.size(); ++i)
      result.parameters[static_cast<Eigen::Index>(i)] *= names[i].starts_with("bx")   ? change.bx_times
                                                         : names[i].starts_with("by") ? change.by_times
                                                                                      : 1.;
    result.frequency_Hz *= change.frequency_times;
    return result;
  }

  double largest_T(const Drive &drive)
  {
    constexpr int n_phases = 96;
    double        largest  = 0.;
    for (int i = 0; i < n_phases; ++i)
      largest = std::max(largest, drive.field->value_T(static_cast<double>(i) / n_phases, drive.parameters).norm());
    return largest;
  }
} // namespace swimtwin
