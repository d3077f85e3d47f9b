// Of which parameter another field is to tell more, and which fields may be proposed.
#pragma once

#include <control/field/field_limits.h>
#include <twin/motion/twin_parameters.h>

namespace swimtwin
{
  struct TellingOptions
  {
    TwinParameter parameter     = TwinParameter::stiffness; ///< estimated; its interval is to become shorter
    double        ahead_periods = 2.;                       ///< after which intervals are compared
    double        every_periods = 20.;                      ///< between proposals
    double        largest_T     = 0.;                       ///< of |B|, at any phase
    FieldLimits   coils         = {};                       ///< kept by the carrier however it is turned
    double        lowest_Hz = 0., highest_Hz = 0.;
    bool keeps_speed = false; ///< the head becomes no slower in the mean, by a twentieth at most: what a goal needs
  };
} // namespace swimtwin
