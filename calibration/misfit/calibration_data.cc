#include <calibration/misfit/calibration_data.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  std::vector<int> CalibrationData::rows_of(const int wanted) const
  {
    std::vector<int> rows;
    for (int i = 0; i < n(); ++i)
      if (set[static_cast<std::size_t>(i)] == wanted)
        rows.push_back(i);
    return rows;
  }

  double CalibrationData::sigma_at(const int wanted, const double f) const
  {
    const std::vector<int> rows = rows_of(wanted);
    const auto after = std::find_if(rows.begin(), rows.end(), [&](const int row) { return frequency_Hz[row] >= f; });
    if (after == rows.begin())
      return sigma_m[rows.front()];
    if (after == rows.end())
      return sigma_m[rows.back()];
    const int    right = *after, left = *std::prev(after);
    const double weight = std::log(f / frequency_Hz[left]) / std::log(frequency_Hz[right] / frequency_Hz[left]);
    return (1. - weight) * sigma_m[left] + weight * sigma_m[right];
  }

  SwimmingCondition condition_of(const ObservationSet &set, const double frequency_Hz)
  {
    return {make_drive(field_at(set, frequency_Hz)), set.period};
  }

  CalibrationData calibration_data(const std::vector<ObservationSet> &sets)
  {
    CalibrationData     data;
    std::vector<double> frequencies, observed, sigmas;
    for (const ObservationSet &set : sets)
    {
      for (const Observation &point : set.points)
      {
        data.conditions.push_back(condition_of(set, point.frequency_Hz));
        data.set.push_back(static_cast<int>(data.set_names.size()));
        frequencies.push_back(point.frequency_Hz);
        observed.push_back(point.displacement_m);
        sigmas.push_back(point.sigma_m);
      }
      data.set_names.push_back(set.name);
    }
    if (observed.empty())
      throw InputError("there are no observations; name a file with --data, or in the problem file as data = [...].");
    const auto vector = [](const std::vector<double> &list) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size())));
    };
    data.frequency_Hz = vector(frequencies);
    data.observed_m   = vector(observed);
    data.sigma_m      = vector(sigmas);
    return data;
  }
} // namespace swimtwin
