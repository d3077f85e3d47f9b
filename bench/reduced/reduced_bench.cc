// Times of a reduced swimmer beside its integration errors: bench_reduced MODEL.h5
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <rom/sweep/sweep.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
  using namespace swimtwin;

  /// CPU seconds per call: the least of several batches, because other processes only ever add to it.
  template <typename Action>
  double time_of(const int n_calls, const Action &action)
  {
    double least = INFINITY;
    for (int batch = 0; batch < 7; ++batch)
    {
      const double start = thread_cpu_time_s();
      for (int i = 0; i < n_calls; ++i)
        action();
      least = std::min(least, (thread_cpu_time_s() - start) / n_calls);
    }
    return least;
  }

  RunRequest nominal_request(const ReducedModel &model)
  {
    const Scene scene = parse_scene(model.scene_text, model.scene_name + ".toml");
    RunRequest  request;
    request.parameters    = swimmer_parameters(scene);
    request.drive         = make_drive(scene.field);
    request.initial_state = SwimmerState::Zero(model.n_modes() + 3);
    return request;
  }

  void time_equations(const ReducedModel &model, const RunRequest &request)
  {
    const ReducedSwimmer  swimmer(model);
    SwimmerMotion         motion      = swimmer.make_motion();
    RateDerivatives       derivatives = swimmer.make_derivatives();
    SwimmerState          state       = request.initial_state;
    const Eigen::Vector2d field_T     = request.drive.field->value_T(0.2, request.drive.parameters);
    state.tail(swimmer.n_modes())     = 0.2 * model.resistance.coordinate_scale_m;
    const double rate = time_of(20'000, [&] { swimmer.set_rate(state, field_T, request.parameters, motion); });
    const double all =
        time_of(5'000, [&] { swimmer.differentiate(state, field_T, request.parameters, motion, derivatives); });
    fmt::print("modes {}, monomials {}\n  right-hand side {:.2f} us, with all derivatives {:.2f} us\n",
               swimmer.n_modes(), model.resistance.exponents.rows(), 1e6 * rate, 1e6 * all);
  }

  void time_periods(const ReducedModel &model, const RunRequest &request)
  {
    const ReducedSwimmer swimmer(model);
    const auto           displacement = [&](const double rtol, const double frequency) {
      RunRequest at         = request;
      at.drive.frequency_Hz = frequency;
      SwimmerIntegrator integrator(swimmer, {.relative_tolerance = rtol});
      return displacement_per_period(integrator.run(at), 0.).back();
    };
    const std::vector<double> frequencies = {0.1, 0.3, 0.8, 2., 3.};
    std::vector<double>       exact;
    for (const double f : frequencies)
      exact.push_back(displacement(1e-12, f));
    fmt::print("  tolerance  worst error of the third period (of the largest)   steps   ms per period, at 0.8 Hz\n");
    const double largest = std::abs(*std::max_element(
        exact.begin(), exact.end(), [](const double a, const double b) { return std::abs(a) < std::abs(b); }));
    for (const double rtol : {1e-4, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-8, 1e-10})
    {
      double worst = 0., worst_of_largest = 0.;
      for (std::size_t i = 0; i < exact.size(); ++i)
      {
        const double error = std::abs(displacement(rtol, frequencies[i]) - exact[i]);
        worst              = std::max(worst, error / std::abs(exact[i]));
        worst_of_largest   = std::max(worst_of_largest, error / largest);
      }
      SwimmerIntegrator integrator(swimmer, {.relative_tolerance = rtol});
      SwimmerRun        run;
      const double      time = time_of(20, [&] { run = integrator.run(request); }) / request.n_periods;
      fmt::print("  {:<9.0e}  {:>8.4f} % ({:.4f} %)  {:>6}  {:>7.3f}\n", rtol, 100. * worst, 100. * worst_of_largest,
                 run.n_steps, 1e3 * time);
    }
  }

  void time_orbit(const ReducedModel &model, RunRequest request)
  {
    const ReducedSwimmer swimmer(model);
    request.initial_state = SwimmerIntegrator(swimmer, {}).run(request).at_period_end.back();
    for (const bool exact : {true, false})
    {
      PeriodicOrbitFinder finder(swimmer, {.exact_multipliers = exact});
      PeriodicOrbit       orbit;
      const double        time = time_of(5, [&] { orbit = finder.find(request); });
      fmt::print("  periodic motion, {} multipliers: {} Newton steps, {} periods, {:.2f} ms\n",
                 exact ? "exact" : "near", orbit.n_newton_steps, orbit.n_periods, 1e3 * time);
    }
  }

  void time_sweep(const ReducedModel &model, const RunRequest &request, const bool everything)
  {
    SweepAxes axes;
    axes.young_modulus_Pa = {5e4, 8e4, 2e5};
    for (int i = 0; i < 60; ++i)
      axes.frequency_Hz.push_back(0.1 + 2.9 * i / 59.);
    SweepOptions options;
    options.base      = request;
    options.n_threads = 2;
    options.periodic = options.indicator = everything;
    const double start                   = wall_time_s();
    const auto   results                 = sweep(model, axes, options);
    double       cpu                     = 0.;
    for (const SweepResult &result : results)
      cpu += result.cpu_time_s;
    fmt::print("  {} runs of 3 periods{}: {:.3f} s on 2 threads, {:.3f} s of CPU time\n", results.size(),
               everything ? ", periodic motion and error indicator" : "", wall_time_s() - start, cpu);
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc != 2)
  {
    fmt::print(stderr, "usage: bench_reduced MODEL.h5\n");
    return 2;
  }
  try
  {
    const ReducedModel model   = read_reduced_model(argv[1]);
    const RunRequest   request = nominal_request(model);
    time_equations(model, request);
    time_periods(model, request);
    time_orbit(model, request);
    time_sweep(model, request, false);
    time_sweep(model, request, true);
    return 0;
  }
  catch (const InputError &error)
  {
    fmt::print(stderr, "bench_reduced: {}\n", error.what());
    return 2;
  }
}
