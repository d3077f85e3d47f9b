#include <calibration/misfit/motion_groups.h>

#include <cmath>

namespace swimtwin
{
  MotionGroups::MotionGroups(const CalibrationModel &model)
      : nominal_(model.nominal), has_magnetic_tail_(model.base.parameters.tail_magnetization_A_m != 0.),
        has_inertia_(model.swimmer.has_inertia())
  {
    slopes_.resize(2 + has_magnetic_tail_ + has_inertia_, n_motion_quantities);
    slopes_.row(0) << 1., -1., 0., 0.;
    slopes_.row(1) << 0., -1., 1., 1.;
    if (has_magnetic_tail_)
      slopes_.row(2) << 0., -1., 0., 1.;
    if (has_inertia_)
      slopes_.bottomRows<1>() << 0., 1., 0., 0.;
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
    if (has_inertia_)
      s.viscosity_Pa_s = std::exp(groups[size() - 1]);
    s.young_modulus_Pa  = std::exp(groups[0]) * s.viscosity_Pa_s;
    s.field_scale       = has_magnetic_tail_ ? std::exp(groups[2]) * s.viscosity_Pa_s : 1.;
    s.magnetization_A_m = std::exp(groups[1]) * s.viscosity_Pa_s / s.field_scale;
    return s;
  }
} // namespace swimtwin
