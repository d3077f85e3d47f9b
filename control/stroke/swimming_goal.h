// What a periodic field is to reach, and within which limits.
#pragma once

#include <control/field/field_limits.h>
#include <control/field/field_variables.h>
#include <control/stroke/motion_limits.h>
#include <control/stroke/stroke_terms.h>

#include <filesystem>
#include <map>
#include <optional>

namespace swimtwin
{
  /// A plan for swimmers that are as likely as the data allow.
  struct RobustAim
  {
    std::filesystem::path calibration; ///< empty: plan for the one swimmer
    /// The objective is the best value that all but this fraction of the swimmers reach; 0: the worst case.
    double left_out  = 0.;
    int    n_members = 8; ///< of the calibration's sample
  };

  struct SwimmingGoal
  {
    /// Weights of the terms, each relative to its size in the reference sinusoid. Gains (speed, displacement,
    /// efficiency) are maximised and costs minimised by positive weights.
    std::map<StrokeTerm, double> weights;
    SwimmerParameters            swimmer;
    InertiaTerms                 inertia;          ///< that the swimmer carries
    double                       heading_rad = 0.; ///< the swimmer travels along -(cos, sin) of it

    FieldFamily  family      = FieldFamily::general;
    int          n_harmonics = 5;
    FieldLimits  field;
    MotionLimits motion;
    Interval     frequency_Hz;
    RobustAim    robust;
  };

  /// The largest |B| that the limits on magnitude, components and currents allow. Infinite where they do not limit it.
  double largest_magnitude_T(const FieldLimits &limits);
} // namespace swimtwin
