#include <rom/training/run_parameters.h>

#include <cmath>

namespace swimtwin
{
  RunParameters parameters_of(const Scene &scene)
  {
    const double period = scene.field.period_s(); // at a crest of by, after any ramp:
    const auto   crest  = scene.field((.25 + std::ceil(scene.field.ramp_s / period)) * period);
    return {scene.tail->young_modulus_Pa,
            scene.fluid->viscosity_Pa_s,
            scene.head.magnetization_A_m,
            1. / period,
            crest[0],
            crest[1]};
  }

  RunParameters parameters_of(const HeldOutRun &run)
  {
    return {run.young_modulus_Pa, run.viscosity_Pa_s, run.magnetization_A_m, run.frequency_Hz, run.bx_T, run.by_T};
  }
} // namespace swimtwin
