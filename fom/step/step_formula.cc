#include <fom/step/step_formula.h>

#include <fom/body/given_motion.h>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  Configuration<dim> known_configuration(const Swimmer<dim> &swimmer, const Bdf2 &bdf, const Instant<dim> &now,
                                         const Instant<dim> &before)
  {
    const Configuration<dim> &last = now.configuration, &first = before.configuration;
    const auto                middle = [&](const Configuration<dim> &c) -> Tensor<1, dim> {
      return c.pose.to_laboratory(swimmer.arm_to_middle(c.shape));
    };
    Configuration<dim> known;
    known.pose.center = Point<dim>(bdf.known(middle(last), middle(first)));
    known.pose.set_attitude(last.pose);
    known.pose.turn(bdf.before_weight * first.pose.turn_from(last.pose));
    known.shape.resize(last.shape.size());
    for (unsigned int a = 0; a < last.shape.size(); ++a)
      known.shape[a] = bdf.known(last.shape[a], first.shape[a]);
    return known;
  }

  template <int dim>
  std::optional<BodyVelocities<dim>> known_velocities(const Swimmer<dim> &swimmer, const Bdf2 &bdf,
                                                      const Instant<dim> &now, const Instant<dim> &before)
  {
    if (!swimmer.inertia().of_body())
      return std::nullopt;
    const BodyVelocities<dim> last  = swimmer.velocities(now.configuration, now.rates),
                              first = swimmer.velocities(before.configuration, before.rates);
    BodyVelocities<dim> known{
        bdf.known(last.head, first.head), bdf.known(last.omega, first.omega), bdf.known(last.spin, first.spin), {}};
    for (unsigned int a = 0; a < last.tail.size(); ++a)
      known.tail.push_back(bdf.known(last.tail[a], first.tail[a]));
    return known;
  }

  template <int dim>
  Rates<dim> extrapolated_rates(const Instant<dim> &now, const Instant<dim> &before, const double growth)
  {
    Rates<dim> result = now.rates;
    if (growth == 0.)
      return result;
    result.velocity += growth * (now.rates.velocity - before.rates.velocity);
    result.omega += growth * (now.rates.omega - before.rates.omega);
    for (unsigned int a = 0; a < result.shape_rate.size(); ++a)
      result.shape_rate[a] += growth * (now.rates.shape_rate[a] - before.rates.shape_rate[a]);
    return result;
  }

  template <int dim>
  void take_given_rates(const Swimmer<dim> &swimmer, const TimeStep<dim> &step, Rates<dim> &rates)
  {
    const Scene &scene = swimmer.scene();
    if (scene.head.is_driven())
    {
      const RigidPose<dim> pose = given_pose<dim>(scene.head, step.time_s).pose;
      rates.velocity            = (pose.center - step.known.pose.center) / step.slope_weight;
      const auto turn           = pose.turn_from(step.known.pose);
      for (int k = 0; k < n_rotations<dim>; ++k)
        rates.omega[k] = turn[k] / step.slope_weight;
    }
    if (scene.tail && scene.tail->is_driven())
    {
      const NodalField<dim> shape = given_shape(swimmer, step.time_s);
      for (unsigned int a = 0; a < shape.size(); ++a)
        rates.shape_rate[a] = (shape[a] - step.known.shape[a]) / step.slope_weight;
    }
  }

  template <int dim>
  std::optional<BodyVelocities<dim>> acceleration(const Swimmer<dim> &swimmer, const TimeStep<dim> &step,
                                                  const Instant<dim> &now)
  {
    if (!step.known_velocities)
      return std::nullopt;
    const BodyVelocities<dim> &known = *step.known_velocities;
    BodyVelocities<dim>        a     = swimmer.velocities(now.configuration, now.rates);
    a.head                           = (a.head - known.head) / step.slope_weight;
    a.omega                          = (a.omega - known.omega) / step.slope_weight;
    a.spin                           = (a.spin - known.spin) / step.slope_weight;
    for (unsigned int i = 0; i < a.tail.size(); ++i)
      a.tail[i] = (a.tail[i] - known.tail[i]) / step.slope_weight;
    return a;
  }

  template Configuration<2>                 known_configuration<2>(const Swimmer<2> &, const Bdf2 &, const Instant<2> &,
                                                   const Instant<2> &);
  template std::optional<BodyVelocities<2>> known_velocities<2>(const Swimmer<2> &, const Bdf2 &, const Instant<2> &,
                                                                const Instant<2> &);
  template void                             take_given_rates<2>(const Swimmer<2> &, const TimeStep<2> &, Rates<2> &);
  template Rates<2>                         extrapolated_rates<2>(const Instant<2> &, const Instant<2> &, double);
  template std::optional<BodyVelocities<2>> acceleration<2>(const Swimmer<2> &, const TimeStep<2> &,
                                                            const Instant<2> &);
  template Configuration<3>                 known_configuration<3>(const Swimmer<3> &, const Bdf2 &, const Instant<3> &,
                                                   const Instant<3> &);
  template std::optional<BodyVelocities<3>> known_velocities<3>(const Swimmer<3> &, const Bdf2 &, const Instant<3> &,
                                                                const Instant<3> &);
  template void                             take_given_rates<3>(const Swimmer<3> &, const TimeStep<3> &, Rates<3> &);
  template Rates<3>                         extrapolated_rates<3>(const Instant<3> &, const Instant<3> &, double);
  template std::optional<BodyVelocities<3>> acceleration<3>(const Swimmer<3> &, const TimeStep<3> &,
                                                            const Instant<3> &);
} // namespace swimtwin
