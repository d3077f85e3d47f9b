#include <rom/training/explored_shapes.h>

#include <rom/integration/swimmer_integrator.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    double at(const Interval &range, const double share)
    {
      return range.low > 0. ? range.low * std::pow(range.high / range.low, share)
                            : range.low + share * (range.high - range.low);
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

  RunRequest request_of(const RunParameters &member, const Scene &scene, const ReducedSwimmer &swimmer)
  {
    RunRequest request;
    request.parameters                   = swimmer_parameters(scene);
    request.parameters.young_modulus_Pa  = member.young_modulus_Pa;
    request.parameters.viscosity_Pa_s    = member.viscosity_Pa_s;
    request.parameters.magnetization_A_m = member.magnetization_A_m;
    request.drive.field                  = std::make_shared<SinusoidalField>();
    request.drive.parameters             = Eigen::Vector2d(member.bx_T, member.by_T);
    request.drive.frequency_Hz           = member.frequency_Hz;
    request.initial_state                = SwimmerState::Zero(swimmer.n_states());
    request.initial_state[2]             = scene.head.angle_rad;
    request.n_periods                    = 3;
    request.samples_per_period           = 40;
    return request;
  }

  std::vector<ExploredPoint> explore(const ReducedModel &model, const Scene &scene,
                                     const std::vector<RunParameters> &members, const ShapePoint &rest)
  {
    IntegratorOptions options;
    options.relative_tolerance = 1e-5;
    const ReducedSwimmer       swimmer(model);
    SwimmerIntegrator          integrator(swimmer, options);
    std::vector<ExploredPoint> points;
    for (const auto &member : members)
      for (const auto &snapshot : integrator.run(request_of(member, scene, swimmer)).snapshots)
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

  std::vector<ShapePoint> shapes_of(const std::vector<ExploredPoint> &points)
  {
    std::vector<ShapePoint> shapes;
    for (const auto &point : points)
      shapes.push_back(point.shape);
    return shapes;
  }
} // namespace swimtwin
