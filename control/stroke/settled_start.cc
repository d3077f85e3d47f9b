#include <control/stroke/settled_start.h>
#include <datasets/system/error.h>

#include <boost/math/tools/minima.hpp>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double farthest_rad = 1.2;
    constexpr int    n_tries      = 12; // before Brent's method narrows the best one down
  }                                     // namespace

  double settled_start_angle_rad(const ReducedSwimmer &swimmer, const RunRequest &request,
                                 const SwimmerState &orbit_start, const int n_periods)
  {
    SwimmerIntegrator integrator(swimmer, {});
    RunRequest        trial   = request;
    trial.n_periods           = n_periods;
    trial.samples_per_period  = 0;
    const Eigen::Index n      = swimmer.n_modes() + 1;
    Eigen::VectorXd    weight = Eigen::VectorXd::Constant(n, 1. / swimmer.length_m());
    weight[0]                 = 1.;
    const auto distance       = [&](const double angle) {
      trial.initial_state  = state_at_rest(swimmer, angle);
      const SwimmerRun run = integrator.run(trial);
      if (!run.completed())
        return std::numeric_limits<double>::max();
      const Eigen::VectorXd away = run.at_period_end.back().segment(2, n) - orbit_start.segment(2, n);
      return weight.cwiseProduct(away).norm();
    };
    const double step = 2. * farthest_rad / n_tries, first = orbit_start[2] - farthest_rad;
    double       best = first, smallest = std::numeric_limits<double>::max();
    for (int i = 0; i <= n_tries; ++i)
      if (const double d = distance(first + i * step); d < smallest)
      {
        smallest = d;
        best     = first + i * step;
      }
    if (smallest == std::numeric_limits<double>::max())
      throw ComputationError("no start was found from which the swimmer moves for some periods in this field");
    constexpr int bits = 14;
    return boost::math::tools::brent_find_minima(distance, best - step, best + step, bits).first;
  }
} // namespace swimtwin
