// Coverage of 95 % intervals in 400 synthetic fits, and the time of one fit:
//   bench_calibration coverage MODEL.h5 [number of fits]
//   bench_calibration time MODEL.h5
//   bench_calibration bias MODEL.h5 DATA.csv E/mu M/mu    (full-order data with their noise and without it)
//   bench_calibration seeds MODEL.h5 DATA.csv E/mu M/mu [n]    (and with n other draws of noise)
#include <calibration/run/calibrate.h>
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <datasets/system/parallel_for.h>

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

namespace
{
  using namespace swimtwin;

  constexpr double true_young_modulus_Pa = 8e4, true_magnetization_A_m = 1.3e5, relative_noise = 0.02;

  /// Frequencies of the reference field, evenly spread in their logarithm; displacements are set later.
  ObservationSet conditions(const int n, const double low_Hz, const double high_Hz)
  {
    ObservationSet set;
    set.name  = "synthetic";
    set.field = FieldProgram::sinusoidal(5e-3, 5e-3, 1.);
    for (int i = 0; i < n; ++i)
      set.points.push_back({low_Hz * std::pow(high_Hz / low_Hz, i / (n - 1.)), 1e-6, 1e-6, "", 0, 0., 0.});
    return set;
  }

  CalibrationProblem two_ratios()
  {
    CalibrationProblem problem;
    FreeParameter      stiffness, magnet;
    stiffness.quantity  = FittedQuantity::young_modulus_over_viscosity;
    stiffness.lower     = 2e4;
    stiffness.upper     = 2e5;
    magnet.quantity     = FittedQuantity::magnetization_over_viscosity;
    magnet.lower        = 5e4;
    magnet.upper        = 1.5e5;
    problem.free        = {stiffness, magnet};
    problem.model_error = 0.; // the truth is the reduced model itself
    return problem;
  }

  CalibratedSwimmer truth_of(const CalibrationModel &model)
  {
    CalibratedSwimmer truth = model.nominal;
    truth.young_modulus_Pa  = true_young_modulus_Pa;
    truth.magnetization_A_m = true_magnetization_A_m;
    return truth;
  }

  /// Displacements of the truth, with noise of 2 % of each drawn by the seed.
  void observe(const Eigen::VectorXd &displacement_m, const unsigned int seed, CalibrationData &data)
  {
    std::mt19937_64                  engine(seed);
    std::normal_distribution<double> normal;
    data.sigma_m = relative_noise * displacement_m.cwiseAbs();
    for (int i = 0; i < data.n(); ++i)
      data.observed_m[i] = displacement_m[i] + data.sigma_m[i] * normal(engine);
  }

  struct Coverage
  {
    int curvature[2] = {0, 0}, profile[2] = {0, 0}, n_failed = 0;
  };

  bool holds(const ClaimedInterval &interval, const double value)
  {
    return interval.is_finite() && *interval.low <= value && value <= *interval.high;
  }

  void count(const FitInput &input, const std::shared_ptr<DisplacementTable> &table, const Eigen::VectorXd &truth,
             Coverage &coverage)
  {
    const double   factor   = coverage_factor(0.95, false, input.data.n() - 2);
    const Estimate estimate = fit_near(input, table, truth);
    coverage.n_failed += estimate.polished ? 0 : 1;
    for (int j = 0; j < 2; ++j)
    {
      const double value = input.map.value(j, truth[j]);
      coverage.curvature[j] += holds(curvature_interval(input, estimate, j, factor), value);
      coverage.profile[j] += holds(profile_of(input, estimate, j, factor).interval, value);
    }
  }

  void measure_coverage(const ReducedModel &reduced, const int n_fits)
  {
    const CalibrationModel   model(reduced);
    const CalibrationProblem problem = two_ratios();
    const CalibrationData    data    = calibration_data({conditions(12, 0.1, 2.5)});
    const ParameterMap       map(problem, model.nominal, 1e-4);
    const CalibratedSwimmer  truth = truth_of(model);
    ExactDisplacements       exact(model, data.conditions, {.relative_tolerance = 1e-9, .n_threads = 2, .by = {}});
    const Eigen::VectorXd    displacement = exact.evaluate(truth, false).value_m;

    const Eigen::VectorXd                    x = map.nominal().NullaryExpr(2, [&](const Eigen::Index j) {
      return map.scaled(static_cast<int>(j), value_of(map.free()[static_cast<std::size_t>(j)].quantity, truth));
    });
    std::string                              failure;
    const std::shared_ptr<DisplacementTable> table = DisplacementTable::make(
        model, data.conditions,
        map.group_box(MotionGroups(model), (x.array() - 0.3).matrix(), (x.array() + 0.3).matrix()),
        {.relative_tolerance = 1e-8, .interpolation_error = 1e-5, .n_threads = 2}, failure);
    fmt::print("table: interpolation error {:.1e}\n", table->interpolation_error());
    Coverage   total;
    std::mutex adding;
    parallel_for(static_cast<std::size_t>(n_fits), 2, [&] {
      return [&](const std::size_t i) {
        CalibrationData observed = data;
        observe(displacement, static_cast<unsigned int>(i + 1), observed);
        Coverage       own;
        const FitInput input{model, reduced, problem, observed, map, 1};
        count(input, std::shared_ptr<DisplacementTable>(table->copy()), x, own);
        const std::lock_guard lock(adding);
        for (int j = 0; j < 2; ++j)
        {
          total.curvature[j] += own.curvature[j];
          total.profile[j] += own.profile[j];
        }
        total.n_failed += own.n_failed;
      };
    });
    fmt::print("{} fits (seeds 1 to {}), 12 frequencies, 2 % noise; 95 % intervals that hold the truth:\n"
               "  E/mu: {} by profile, {} by curvature\n  M/mu: {} by profile, {} by curvature\n"
               "  fits that did not converge: {}\n",
               n_fits, n_fits, total.profile[0], total.curvature[0], total.profile[1], total.curvature[1],
               total.n_failed);
  }

  void measure_time(const ReducedModel &reduced)
  {
    const CalibrationModel model(reduced);
    ObservationSet         set  = conditions(20, 0.1, 2.5);
    CalibrationData        data = calibration_data({set});
    ExactDisplacements     exact(model, data.conditions, {.relative_tolerance = 1e-9, .n_threads = 2, .by = {}});
    observe(exact.evaluate(truth_of(model), false).value_m, 1, data);
    for (std::size_t i = 0; i < set.points.size(); ++i)
    {
      set.points[i].displacement_m = data.observed_m[static_cast<Eigen::Index>(i)];
      set.points[i].sigma_m        = data.sigma_m[static_cast<Eigen::Index>(i)];
    }
    const double            wall = wall_time_s(), cpu = process_cpu_time_s();
    const CalibrationResult result = calibrate(reduced, two_ratios(), {set}, {.n_threads = 2});
    fmt::print(
        "2 free ratios, 20 frequencies, {} starts, 2 threads: fit {:.2f} s, profiles, {} bootstrap fits, band and "
        "next experiment {:.2f} s; all {:.2f} s of wall time, {:.2f} s of CPU time\n"
        "  {} runs of the reduced swimmer, status {}\n",
        result.starts.size(), result.fit_time_s, result.bootstrap.rows(), result.uncertainty_time_s,
        wall_time_s() - wall, process_cpu_time_s() - cpu, result.n_runs, result.status);
    for (const CalibratedParameter &p : result.parameters)
      if (p.role == ParameterRole::free)
        fmt::print("  {}: {:.5g}, profile {:.5g} to {:.5g}, bootstrap {:.5g} to {:.5g}\n", p.name, p.value,
                   p.profile.low.value_or(NAN), p.profile.high.value_or(NAN), p.bootstrap.low.value_or(NAN),
                   p.bootstrap.high.value_or(NAN));
  }

  /// Bounds that hold every shipped set, the model's own error from its held-out runs.
  CalibrationProblem of_full_order_data()
  {
    CalibrationProblem problem = two_ratios();
    problem.model_error.reset();
    problem.free[0].upper = 4e5;
    problem.free[1].upper = 3e5;
    return problem;
  }

  ObservationSet without_noise(ObservationSet set)
  {
    for (std::size_t i = 0; i < set.points.size(); ++i)
      set.points[i].displacement_m = std::stod(set.extra_columns.at("displacement_without_noise_m")[i]);
    return set;
  }

  /// How often intervals hold the full-order model's truth whose noise is drawn anew.
  void count_seeds(const ReducedModel &reduced, const char *file, const double (&truth)[2], const int n)
  {
    CalibrationProblem problem     = of_full_order_data();
    problem.n_bootstrap_samples    = 0;
    const ObservationSet exact     = without_noise(read_observations(file));
    int                  inside[2] = {0, 0}, both = 0;
    for (int seed = 1; seed <= n; ++seed)
    {
      ObservationSet                   set = exact;
      std::mt19937_64                  engine(static_cast<unsigned int>(seed));
      std::normal_distribution<double> normal;
      for (Observation &point : set.points)
        point.displacement_m += point.sigma_m * normal(engine);
      const CalibrationResult result = calibrate(reduced, problem, {set}, {.n_threads = 2});
      int                     held   = 0;
      for (int j = 0; j < 2; ++j)
      {
        const bool holds_it = holds(result.parameters[static_cast<std::size_t>(j)].profile, truth[j]);
        inside[j] += holds_it;
        held += holds_it;
      }
      both += held == 2;
    }
    fmt::print("{}: {} draws of noise (seeds 1 to {}): the 95 % interval holds E/mu {} times, M/mu {} times, both {}\n",
               exact.name, n, n, inside[0], inside[1], both);
  }

  /// Fits full-order data as they are, and once more without their noise: what is then left is the reduced model's
  /// bias.
  void measure_bias(const ReducedModel &reduced, const char *file, const double (&truth)[2])
  {
    const ObservationSet as_they_are = read_observations(file);
    for (const bool noise : {true, false})
    {
      const ObservationSet    set    = noise ? as_they_are : without_noise(as_they_are);
      const CalibrationResult result = calibrate(reduced, of_full_order_data(), {set}, {.n_threads = 2});
      fmt::print("{} {} noise, model error {:.2g} %:\n", set.name, noise ? "with" : "without",
                 100. * result.discrepancy.relative_size);
      for (int j = 0; j < 2; ++j)
      {
        const CalibratedParameter &p    = result.parameters[static_cast<std::size_t>(j)];
        const double               half = 0.5 * (*p.profile.high - *p.profile.low);
        fmt::print("  {}: {:.5g} ({:+.2f} %), interval {:.5g} to {:.5g}; off by {:.2f} of half the interval\n", p.name,
                   p.value, 100. * (p.value / truth[j] - 1.), *p.profile.low, *p.profile.high,
                   std::abs(p.value - truth[j]) / half);
      }
    }
  }
} // namespace

int main(int argc, char **argv)
{
  const std::string what = argc < 3 ? "" : argv[1];
  if (what != "coverage" && what != "time" && (what != "bias" || argc != 6) && (what != "seeds" || argc < 6))
  {
    fmt::print(stderr, "usage: bench_calibration coverage|time MODEL.h5 [number of fits]\n"
                       "       bench_calibration bias MODEL.h5 DATA.csv E/mu M/mu\n"
                       "       bench_calibration seeds MODEL.h5 DATA.csv E/mu M/mu [number of draws]\n");
    return 2;
  }
  try
  {
    const ReducedModel model = read_reduced_model(argv[2]);
    if (what == "coverage")
      measure_coverage(model, argc > 3 ? std::atoi(argv[3]) : 400);
    else if (what == "time")
      measure_time(model);
    else if (what == "seeds")
      count_seeds(model, argv[3], {std::stod(argv[4]), std::stod(argv[5])}, argc > 6 ? std::atoi(argv[6]) : 20);
    else
      measure_bias(model, argv[3], {std::stod(argv[4]), std::stod(argv[5])});
    return 0;
  }
  catch (const InputError &error)
  {
    fmt::print(stderr, "bench_calibration: {}\n", error.what());
    return 2;
  }
}
