#include <rom/training/explored_shapes.h>

#include <rom/swimmer_integrator.h>

#include <algorithm>
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

  std::vector<ShapePoint> explored_points(const ReducedModel &model, const std::vector<RunParameters> &members,
                                          const ShapePoint &rest)
  {
    IntegratorOptions options;
    options.relative_tolerance = 1e-5;
    const ReducedSwimmer    swimmer(model);
    SwimmerIntegrator       integrator(swimmer, options);
    std::vector<ShapePoint> points;
    for (const auto &member : members)
      for (const auto &snapshot : integrator.run(request_of(member, model)).snapshots)
      {
        points.push_back(rest);
        points.back().q = snapshot.state.tail(model.n_modes());
        if (model.resistance.depends_on_angle)
          points.back().angle_rad = snapshot.state[2];
      }
    return points;
  }

  double largest_radius(const std::vector<ShapePoint> &points, const SampledRegion &region)
  {
    double largest = 0.;
    for (const auto &point : points)
    {
      largest = std::max(largest, point.q.cwiseQuotient(region.coordinate_scale_m).norm());
      if (region.depends_on_angle)
        largest = std::max(largest, std::abs(point.angle_rad) / region.angle_scale_rad);
    }
    return largest;
  }
} // namespace swimtwin
