#include <rom/training/held_out_runs.h>

#include <datasets/run/run_summary_json.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace swimtwin
{
  namespace
  {
    constexpr int n_periods = 3;

    double displacement_of_last_period(const std::filesystem::path &summary)
    {
      const auto displacement_m = read_run_summary_json(summary).summary.net_displacement_m;
      if (!displacement_m)
        throw InputError(
            fmt::format("{}: a full period is missing; remove its folder and train again", summary.string()));
      return *displacement_m;
    }

    /// Displacement of the last period of each member's run.
    std::vector<double> full_order_displacements(const Scene &scene, const std::vector<RunParameters> &members,
                                                 TrainingRunOptions options, const int steps_per_period,
                                                 const MPI_Comm communicator)
    {
      options.folder /= fmt::format("{}-steps", steps_per_period);
      for (const auto &setting :
           {fmt::format("time.periods={}", n_periods), fmt::format("time.steps_per_period={}", steps_per_period),
            std::string("output.snapshots_per_period=1"), std::string("output.fields_per_period=0")})
        options.overrides.push_back(setting);
      std::vector<double> displacements;
      for (const auto &folder : run_full_order(scene, members, options, communicator))
        displacements.push_back(displacement_of_last_period(folder / "summary.json"));
      return displacements;
    }
  } // namespace

  SweepResult predict(const ReducedModel &model, const Scene &scene, const RunParameters &parameters,
                      const InertialDensities &densities)
  {
    const auto  &p       = parameters;
    SweepOptions options = sweep_options(scene, model);
    options.densities    = densities;
    options.n_periods    = n_periods;
    options.periodic     = false;
    options.n_threads    = 1;
    return sweep(
               model,
               {{p.young_modulus_Pa}, {p.viscosity_Pa_s}, {p.magnetization_A_m}, {p.bx_T}, {p.by_T}, {p.frequency_Hz}},
               options)
        .front();
  }

  std::vector<HeldOutRun> compare_with_known(const ReducedModel &model, const Scene &scene,
                                             std::vector<HeldOutRun> runs)
  {
    for (HeldOutRun &run : runs)
    {
      const SweepResult predicted = predict(model, scene, parameters_of(run));
      run.reduced_displacement_m  = predicted.displacement_m;
      run.indicator_m             = predicted.error_indicator_m;
      run.fit_change_m            = predicted.fit_change_m;
    }
    return runs;
  }

  std::vector<HeldOutRun> compare_with_full_order(const ReducedModel &model, const Scene &scene,
                                                  const std::vector<RunParameters> &members,
                                                  const TrainingRunOptions &options, const MPI_Comm communicator)
  {
    const int               steps = std::max(100, scene.time.steps_per_period);
    const auto              fine  = full_order_displacements(scene, members, options, steps, communicator);
    const auto              half  = full_order_displacements(scene, members, options, steps / 2, communicator);
    std::vector<HeldOutRun> runs;
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      const auto &p = members[k];
      runs.push_back({p.young_modulus_Pa, p.viscosity_Pa_s, p.magnetization_A_m, p.frequency_Hz, p.bx_T, p.by_T,
                      fine[k], std::abs(fine[k] - half[k]) / 3.}); // second order in the step
    }
    return compare_with_known(model, scene, std::move(runs));
  }

  std::vector<HeldOutRun> compare_with_inertia(const ReducedModel &model, const Scene &scene,
                                               const std::vector<RunParameters> &members,
                                               const TrainingRunOptions &options, const MPI_Comm communicator)
  {
    TrainingRunOptions carried        = options;
    carried.overrides                 = {"fluid.inertia=full"};
    const InertialDensities densities = inertial_densities(scene, all_inertia);
    const auto              displacements =
        full_order_displacements(scene, members, carried, scene.time.steps_per_period, communicator);
    std::vector<HeldOutRun> runs;
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      const auto &p = members[k];
      runs.push_back({p.young_modulus_Pa, p.viscosity_Pa_s, p.magnetization_A_m, p.frequency_Hz, p.bx_T, p.by_T,
                      displacements[k], 0., predict(model, scene, p, densities).displacement_m, 0., 0.});
    }
    return runs;
  }
} // namespace swimtwin
