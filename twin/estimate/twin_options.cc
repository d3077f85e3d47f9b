#include <datasets/reduced/held_out_error.h>
#include <twin/estimate/twin_options.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    /// In a period the model is off by this share of what moves in it: of half a body length's way to and fro, of a
    /// swing of half a radian, of half the trained amplitudes.
    ModelNoise model_noise(const ReducedModel &model, const double length_m, const double period_s)
    {
      const double share = held_out_displacement_error(model) / std::sqrt(period_s);
      return {0.5 * share * length_m, 0.5 * share,
              0.5 * share * model.resistance.coordinate_scale_m.head(model.n_modes())};
    }
  } // namespace

  double held_out_displacement_error(const ReducedModel &model)
  {
    const HeldOutError error = displacement_error(model.record);
    return error.n_runs > 0 ? std::max(1e-3, error.rms) : 0.01;
  }

  TwinOptions default_twin_options(const ReducedModel &model, const SwimmerParameters &nominal,
                                   const double frequency_Hz)
  {
    const double length_m = ReducedSwimmer(model).length_m();
    const double period_s = 1. / frequency_Hz;
    // Modes fade: each is unsure by a share of the amplitude that the model was trained for.
    const Eigen::VectorXd amplitude_m = model.resistance.coordinate_scale_m.head(model.n_modes());
    TwinOptions           options;
    options.nominal             = nominal;
    options.search_pose_after_s = 0.5 * period_s;
    options.largest_step_s      = period_s / 40.;
    options.noise               = model_noise(model, length_m, period_s);
    options.first_sigmas        = {0.003 * length_m, std::numbers::pi / 180.};
    options.start               = {{}, 0.5, 0.1 * amplitude_m, period_s};
    options.filter.window_s     = std::max(1., 2. * period_s);
    options.jumps.interval_s    = 0.5 * period_s;
    options.jumps.settle_s      = 4. * period_s;
    options.delay_search_s      = 3. * period_s;
    options.delay_search_step_s = 0.02 * period_s;
    return options;
  }
} // namespace swimtwin
