#include <rom/training/explored_shapes.h>

#include <rom/integration/swimmer_integrator.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    double at(const Interval &range, const double share)
    {
      return range.low > 0. ? range.low * std::pow(range.high / range.low, share)
                            : range.low + share * (range.high - range.low);
    }

    RunRequest request_of(const RunParameters &member, const ReducedModel &model)
    {
      RunRequest request;
      request.parameters         = {member.young_modulus_Pa, member.viscosity_Pa_s, member.magnetization_A_m, 0.};
      request.drive.field        = std::make_shared<SinusoidalField>();
      request.drive.parameters   = Eigen::Vector2d(member.bx_T, member.by_T);
      request.drive.frequency_Hz = member.frequency_Hz;
      request.initial_state      = SwimmerState::Zero(model.n_modes() + 3);
      request.n_periods          = 3;
      request.samples_per_period = 40;
      return request;
    }
  } // namespace

  std::vector<RunParameters> spread_members(const TrainedRange &range, const int n, const int first)
  {
    std::vector<RunParameters> members;
    for (int k = first; k < first + n; ++k)
      members.push_back({at(range.young_modulus_Pa, halton(k, 2)), at(range.viscosity_Pa_s, halton(k, 7)),
                         at(range.magnetization_A_m, halton(k, 5)), at(range.frequency_Hz, halton(k, 3)),
                         at(range.bx_T, halton(k, 11)), at(range.by_T, halton(k, 13))});
    return members;
  }

  std::vector<ExploredPoint> explore(const ReducedModel &model, const std::vector<RunParameters> &members,
                                     const ShapePoint &rest)
  {
    IntegratorOptions options;
    options.relative_tolerance = 1e-5;
    const ReducedSwimmer       swimmer(model);
    SwimmerIntegrator          integrator(swimmer, options);
    std::vector<ExploredPoint> points;
    for (const auto &member : members)
      for (const auto &snapshot : integrator.run(request_of(member, model)).snapshots)
      {
        points.push_back({rest, snapshot.rate});
        points.back().shape.q = snapshot.state.tail(model.n_modes());
        if (model.resistance.depends_on_angle)
          points.back().shape.angle_rad = snapshot.state[2];
        if (model.resistance.depends_on_height)
          points.back().shape.drift_y_m =
              snapshot.state[1] -
              UsualPlace{model.resistance.usual_by_sine_m, model.resistance.usual_by_coordinate}.height_m(
                  {points.back().shape.q, snapshot.state[2]});
        points.back().velocity.head<2>() =
            Eigen::Rotation2Dd(-snapshot.state[2]) * Eigen::Vector2d(snapshot.rate.head<2>());
      }
    return points;
  }

  Eigen::Matrix2Xd third_ways(const ReducedModel &model, const std::vector<RunParameters> &members,
                              const InertialDensities &densities)
  {
    const ReducedSwimmer swimmer(model, densities);
    SwimmerIntegrator    integrator(swimmer, {});
    Eigen::Matrix2Xd     ways(2, members.size());
    for (Eigen::Index k = 0; k < ways.cols(); ++k)
    {
      RunRequest request         = request_of(members[static_cast<std::size_t>(k)], model);
      request.initial_state      = SwimmerState::Zero(swimmer.n_states());
      request.samples_per_period = 0;
      const SwimmerRun run       = integrator.run(request);
      if (run.completed())
        ways.col(k) = run.at_period_end[3].head<2>() - run.at_period_end[2].head<2>();
      else
        ways.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return ways;
  }

  double relative_difference(const Eigen::Matrix2Xd &ways, const Eigen::Matrix2Xd &others)
  {
    const Eigen::RowVectorXd length = others.colwise().norm();
    const Eigen::RowVectorXd apart  = (ways - others).colwise().norm();
    return apart.cwiseQuotient(length.cwiseMax(.05 * length.maxCoeff())).norm() /
           std::sqrt(static_cast<double>(length.size()));
  }

  std::vector<ShapePoint> shapes_of(const std::vector<ExploredPoint> &points)
  {
    std::vector<ShapePoint> shapes;
    for (const auto &point : points)
      shapes.push_back(point.shape);
    return shapes;
  }
} // namespace swimtwin
