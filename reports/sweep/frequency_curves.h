// Displacement against frequency: the curves that the rows of a sweep make.
#pragma once

#include <string>
#include <vector>

namespace swimtwin
{
  /// One run of a sweep.
  struct SweepPoint
  {
    double young_modulus_Pa = 0., magnetization_A_m = 0., frequency_Hz = 0.;
    double displacement_m = 0.;                       ///< per period, positive head first
    double viscosity_Pa_s = 0., bx_T = 0., by_T = 0.; ///< 0 where a table does not say
  };

  struct CurvePoint
  {
    double frequency_Hz = 0., displacement_m = 0.;

    auto operator<=>(const CurvePoint &) const = default;
  };

  struct FrequencyCurve
  {
    std::string             name;   ///< "E = 50000 Pa", and what else differs between the curves
    std::vector<CurvePoint> points; ///< by frequency; not empty

    /// Where the swimmer goes farthest, forwards or backwards.
    const CurvePoint &peak() const;
    /// The peak is the first or the last point: the true one may lie beyond.
    bool peaks_at_its_end() const;
    /// Two points have one frequency: something else differs between the runs.
    bool is_ambiguous() const;
  };

  /// By stiffness, magnetization, viscosity and field; every point belongs to one curve.
  std::vector<FrequencyCurve> frequency_curves(const std::vector<SweepPoint> &points);
} // namespace swimtwin
