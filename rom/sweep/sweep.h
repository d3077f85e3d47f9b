// Many runs of one reduced swimmer, over all combinations of parameter values.
#pragma once

#include <rom/sensitivity/periodic_orbit.h>
#include <rom/sweep/trust.h>

#include <functional>
#include <vector>

namespace swimtwin
{
  /// Values to combine; an empty list stands for the value of the base run.
  struct SweepAxes
  {
    std::vector<double> young_modulus_Pa, viscosity_Pa_s, magnetization_A_m, bx_T, by_T, frequency_Hz;

    std::size_t n_members() const;
  };

  struct SweepOptions
  {
    RunRequest        base; ///< for what the axes leave open; bx and by need its field to be the sinusoid
    double            heading_rad                       = 0.; ///< displacement counts along -(cos, sin)
    int               n_periods                         = 3;  ///< `displacement_m` is that of the last of them
    double            relative_tolerance                = IntegratorOptions().relative_tolerance;
    int               n_threads                         = 0;  ///< 0: as many as the machine has
    InertialDensities densities                         = {}; ///< inertia that all members carry
    bool              periodic                          = true;
    bool              indicator                         = true;
    std::function<void(std::size_t n_done)> on_progress = {}; ///< called by any of the threads, one at a time
  };

  /// Sweeps around a scene's own run: its parameters, field, rest and heading. Throws InputError for a scene that a
  /// reduced swimmer cannot repeat.
  SweepOptions sweep_options(const Scene &scene, const ReducedModel &model);

  struct SweepMember
  {
    SwimmerParameters parameters;
    double            bx_T = 0., by_T = 0.; ///< of the sinusoid; zero for another field
    double            frequency_Hz = 0.;
  };

  /// A displacement that could not be computed is NaN, and `note` says why; so is the indicator of a model with one
  /// mode.
  struct SweepResult
  {
    SweepMember  member;
    double       displacement_m = 0., periodic_displacement_m = 0., error_indicator_m = 0.;
    double       largest_multiplier = 0.; ///< Floquet's, in size
    double       held_out_error     = 0.; ///< relative, that held-out runs nearby had; NaN without any
    double       fit_change_m       = 0.; ///< what fits of the resistance to half of the samples change; 0 without any
    double       error_95_m         = 0.; ///< the full-order displacement is within this with 95 %; NaN if not known
    TrustNotes   trust;
    std::string  note;
    double       cpu_time_s = 0.;
    SwimmerState end; ///< of the last period
  };

  /// Results in the order of the axes, the frequency fastest, then by, bx, magnetization, viscosity, stiffness: the
  /// same to the last bit for any number of threads.
  std::vector<SweepResult> sweep(const ReducedModel &model, const SweepAxes &axes, const SweepOptions &options);

  /// How many threads that takes.
  int n_sweep_threads(const SweepOptions &options, std::size_t n_members);
} // namespace swimtwin
