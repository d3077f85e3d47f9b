// The observations of a fit in one list, with what is needed to repeat each on the reduced model.
#pragma once

#include <datasets/observation/observation_set.h>
#include <rom/swimmer/driving_field.h>

#include <Eigen/Dense>

#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Field, pace, and when to look.
  struct SwimmingCondition
  {
    Drive              drive;
    std::optional<int> period; ///< counted from 1, after a start from rest; none: the periodic motion
  };

  struct CalibrationData
  {
    std::vector<SwimmingCondition> conditions; ///< one per observation
    Eigen::VectorXd                frequency_Hz, observed_m, sigma_m;
    std::vector<int>               set; ///< which data set each belongs to
    std::vector<std::string>       set_names;

    int    n() const { return static_cast<int>(observed_m.size()); }
    double largest_m() const { return observed_m.cwiseAbs().maxCoeff(); }
    /// Rows of one data set.
    std::vector<int> rows_of(int set) const;
    /// Sigma at another frequency: between those of the set's observations, linear in log f.
    double sigma_at(int set, double frequency_Hz) const;
  };

  SwimmingCondition condition_of(const ObservationSet &set, double frequency_Hz);
  /// Throws InputError without any observation.
  CalibrationData calibration_data(const std::vector<ObservationSet> &sets);
} // namespace swimtwin
