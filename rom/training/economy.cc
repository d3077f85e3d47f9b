#include <rom/training/economy.h>

#include <rom/integration/swimmer_integrator.h>
#include <rom/training/explored_shapes.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  Eigen::Matrix2Xd third_ways(const ReducedModel &model, const Scene &scene, const InertialDensities &densities)
  {
    constexpr int     n_members = 12, first = 500; // of the range's, which nothing else runs
    IntegratorOptions options;
    options.relative_tolerance = 1e-8; // steps must not tell models apart
    options.max_steps          = 50'000;
    const ReducedSwimmer    swimmer(model, densities);
    SwimmerIntegrator       integrator(swimmer, options);
    const Eigen::Rotation2D to_heading(-scene.head.angle_rad);
    const auto              members = spread_members(model.range, n_members, first);
    Eigen::Matrix2Xd        ways(2, n_members);
    for (Eigen::Index k = 0; k < n_members; ++k)
    {
      RunRequest request         = request_of(members[static_cast<std::size_t>(k)], scene, swimmer);
      request.samples_per_period = 0;
      const SwimmerRun run       = integrator.run(request);
      const auto       end       = run.at_period_end.rbegin();
      if (run.completed())
        ways.col(k) = to_heading * Eigen::Vector2d(end[0].head<2>() - end[1].head<2>());
      else
        ways.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return ways;
  }

  double relative_difference(const Eigen::Matrix2Xd &ways, const Eigen::Matrix2Xd &others)
  {
    const Eigen::RowVectorXd displacement = others.row(0).cwiseAbs(), apart = (ways - others).colwise().norm();
    return apart.cwiseQuotient(displacement.cwiseMax(.05 * displacement.maxCoeff())).norm() /
           std::sqrt(static_cast<double>(displacement.size()));
  }

  bool are_alike(const Eigen::Matrix2Xd &ways, const Eigen::Matrix2Xd &others, const double target)
  {
    constexpr double unfelt = .1;
    return relative_difference(ways, others) <= unfelt * target;
  }
} // namespace swimtwin
