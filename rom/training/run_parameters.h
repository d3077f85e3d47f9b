// What one run differs in from the next.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>

namespace swimtwin
{
  struct RunParameters
  {
    double young_modulus_Pa = 0., viscosity_Pa_s = 0., magnetization_A_m = 0., frequency_Hz = 0., bx_T = 0., by_T = 0.;
  };

  /// A scene's own. The field must be the reference sinusoid.
  RunParameters parameters_of(const Scene &scene);

  RunParameters parameters_of(const HeldOutRun &run);
} // namespace swimtwin
