// Price and error of the adjoint beside forward sensitivities: bench_adjoint MODEL.h5
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/sensitivity/adjoint_integrator.h>
#include <rom/swimmer/bspline_field.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace swimtwin;

  constexpr int n_periods = 5;

  /// CPU seconds: the least of several, because other processes only ever add to it.
  template <typename Action>
  double time_of(const int n_calls, const Action &action)
  {
    double least = INFINITY;
    for (int i = 0; i < n_calls; ++i)
    {
      const double start = thread_cpu_time_s();
      action();
      least = std::min(least, thread_cpu_time_s() - start);
    }
    return least;
  }

  /// Where the head ends, in one direction.
  class End : public MotionFunctional
  {
  public:
    double terminal(const Eigen::Ref<const Eigen::VectorXd> &y) const override { return y[0] + 0.3 * y[1]; }
    void   add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd>   &/*y*/,
                                 Eigen::Ref<Eigen::VectorXd> by_state) const override
    {
      by_state[0] += 1.;
      by_state[1] += 0.3;
    }
  };

  std::vector<Parameter> field_parameters(const RunRequest &request)
  {
    std::vector<Parameter> parameters;
    for (int i = 0; i < request.drive.parameters.size(); ++i)
      parameters.push_back({Quantity::field, i});
    return parameters;
  }

  Eigen::VectorXd by_sensitivities(SwimmerIntegrator &integrator, const RunRequest &request)
  {
    const SwimmerRun run = integrator.run(request);
    Eigen::VectorXd  end = Eigen::VectorXd::Zero(request.initial_state.size());
    End().add_terminal_gradient(run.at_period_end.back(), end);
    return run.sensitivity_at_period_end.back().transpose() * end;
  }

  /// Five periods of a periodic spline, or of one that never repeats.
  void compare(const ReducedSwimmer &swimmer, RunRequest request, const int n_intervals, const bool is_periodic)
  {
    request.drive              = spline_drive(request.drive, n_intervals, is_periodic, is_periodic ? 1 : n_periods);
    request.n_periods          = is_periodic ? n_periods : 1;
    const double          step = IntegratorOptions().max_step_periods / (is_periodic ? 1 : n_periods);
    const auto            parameters = field_parameters(request);
    SwimmerIntegrator     reference(swimmer,
                                    {.relative_tolerance = 1e-11, .max_step_periods = step, .sensitivities = parameters});
    const Eigen::VectorXd exact = by_sensitivities(reference, request);
    for (const double rtol : {1e-5, 1e-6, 1e-7, 1e-8})
    {
      SwimmerIntegrator plain(swimmer, {.relative_tolerance = rtol, .max_step_periods = step});
      SwimmerIntegrator forward(swimmer,
                                {.relative_tolerance = rtol, .max_step_periods = step, .sensitivities = parameters});
      AdjointIntegrator adjoint(swimmer, {.relative_tolerance = rtol, .max_step_periods = step});
      Eigen::VectorXd   by_forward;
      MotionGradient    gradient;
      const double      run_s     = time_of(7, [&] { plain.run(request); });
      const double      forward_s = time_of(2, [&] { by_forward = by_sensitivities(forward, request); });
      const double      adjoint_s = time_of(7, [&] { gradient = adjoint.differentiate(request, End()); });
      fmt::print("| {} | {:.0e} | {:.1f} | {:.2f} | {:.1e} | {:.1f} | {:.1e} |\n", parameters.size(), rtol, 1e3 * run_s,
                 adjoint_s / run_s, (gradient.by_field - exact).norm() / exact.norm(), forward_s / run_s,
                 (by_forward - exact).norm() / exact.norm());
    }
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc != 2)
  {
    fmt::print(stderr, "usage: bench_adjoint MODEL.h5\n");
    return 2;
  }
  try
  {
    const ReducedModel   model = read_reduced_model(argv[1]);
    const Scene          scene = parse_scene(model.scene_text, model.scene_name + ".toml");
    const ReducedSwimmer swimmer(model);
    const RunRequest     request{swimmer_parameters(scene), make_drive(scene.field), state_at_rest(swimmer), 1, 0};
    fmt::print(
        "| parameters | tolerance | plain run (ms) | adjoint (runs) | its error | forward sensitivities (runs) | "
        "their error |\n|---|---|---|---|---|---|---|\n");
    compare(swimmer, request, 5, true);
    compare(swimmer, request, 97, false);
  }
  catch (const InputError &error)
  {
    fmt::print(stderr, "bench_adjoint: {}\n", error.what());
    return 2;
  }
}
