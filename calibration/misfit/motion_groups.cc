#include <calibration/misfit/motion_groups.h>

#include <cmath>

namespace swimtwin
{
  MotionGroups::MotionGroups(const CalibrationModel &model) : nominal_(model.nominal)
  {
    slopes_.resize(model.base.parameters.tail_magnetization_A_m == 0. ? 2 : 3, n_motion_quantities);
    slopes_.row(0) << 1., -1., 0., 0.;
    slopes_.row(1) << 0., -1., 1., 1.;
    if (size() > 2)
      slopes_.row(2) << 0., -1., 0., 1.;
  }

  Eigen::VectorXd MotionGroups::values(const CalibratedSwimmer &s) const
  {
    Eigen::VectorXd logarithms(n_motion_quantities);
    logarithms << std::log(s.young_modulus_Pa), std::log(s.viscosity_Pa_s), std::log(s.magnetization_A_m),
        std::log(s.field_scale);
    return slopes_ * logarithms;
  }

  CalibratedSwimmer MotionGroups::swimmer(const Eigen::VectorXd &groups) const
  {
    CalibratedSwimmer s = nominal_;
    s.young_modulus_Pa  = std::exp(groups[0]) * s.viscosity_Pa_s;
    s.field_scale       = size() > 2 ? std::exp(groups[2]) * s.viscosity_Pa_s : 1.;
    s.magnetization_A_m = std::exp(groups[1]) * s.viscosity_Pa_s / s.field_scale;
    return s;
  }
} // namespace swimtwin
