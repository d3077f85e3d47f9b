#include <rom/swimmer/state_scale.h>
#include <twin/estimate/twin_options.h>

#include <numbers>

namespace swimtwin
{
  TwinOptions default_twin_options(const ReducedModel &model, const SwimmerParameters &nominal,
                                   const double frequency_Hz)
  {
    const double length_m = ReducedSwimmer(model).length_m();
    const double period_s = 1. / frequency_Hz, stroke_m = stroke_per_length * length_m;
    // Modes fade: each is unsure by a share of the amplitude that the model was trained for.
    const Eigen::VectorXd amplitude_m = model.resistance.coordinate_scale_m.head(model.n_modes());
    TwinOptions           options;
    options.nominal             = nominal;
    options.largest_step_s      = period_s / 40.;
    options.noise               = {1e-4 * stroke_m, 1e-4, 1e-4 * amplitude_m};
    options.first_sigmas        = {0.003 * length_m, std::numbers::pi / 180.};
    options.start               = {{}, 0.5, 0.1 * amplitude_m};
    options.filter.window_s     = std::max(1., 2. * period_s);
    options.jumps.interval_s    = 0.5 * period_s;
    options.jumps.settle_s      = 4. * period_s;
    options.delay_search_s      = 3. * period_s;
    options.delay_search_step_s = 0.02 * period_s;
    return options;
  }
} // namespace swimtwin
