#include <fom/step/power_balance.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Sum of forces on a body, and of their torques about a point.
    template <int dim>
    class LoadSum
    {
    public:
      explicit LoadSum(const Point<dim> &center) : center_(center) {}
      void add(const Point<dim> &x, const Tensor<1, dim> &f)
      {
        force += f;
        torque += torque_of_force<dim>(x - center_, f);
      }
      Tensor<1, dim>       force;
      AngularVelocity<dim> torque;

      Load load() const
      {
        Load load;
        for (int c = 0; c < dim; ++c)
          load.force[c] = force[c];
        for (int k = 0; k < n_rotations<dim>; ++k)
          load.torque[axis_of_rotation<dim>(k)] = torque[k];
        return load;
      }

    private:
      Point<dim> center_;
    };

    template <int dim>
    LoadSum<dim> sum_of_fluid(const Swimmer<dim> &swimmer, const std::vector<double> &force_on_fluid,
                              const Configuration<dim> &configuration)
    {
      LoadSum<dim> sum(configuration.pose.center);
      const auto   x = swimmer.surface(configuration);
      for (unsigned int k = 0; k < x.size(); ++k)
      {
        Tensor<1, dim> on_body;
        for (int c = 0; c < dim; ++c)
          on_body[c] = -force_on_fluid[k * dim + c];
        sum.add(x[k], on_body);
      }
      return sum;
    }

    /// What must hold a fixed head, or drive one whose motion is given: loads and momentum of the whole body balance,
    /// and the tail's internal forces have no resultant.
    template <int dim>
    LoadSum<dim> sum_that_holds(const Swimmer<dim> &swimmer, const LoadSum<dim> &of_fluid,
                                const NodalField<dim> &inertial_force, const Configuration<dim> &configuration,
                                const double time_s)
    {
      LoadSum<dim> sum(configuration.pose.center);
      if (swimmer.has_tail())
      {
        const auto x = swimmer.tail_positions(configuration);
        for (unsigned int a = 0; a < x.size(); ++a)
          sum.add(x[a], -swimmer.load_on_tail_node(a, time_s));
        for (unsigned int a = 0; a < inertial_force.size(); ++a)
          sum.add(x[a], inertial_force[a]);
      }
      sum.force -= of_fluid.force;
      sum.torque -= of_fluid.torque;
      sum.force -= swimmer.force_on_head(time_s);
      sum.torque -= swimmer.torque_on_head(configuration.pose, time_s).torque;
      return sum;
    }

    /// Power of what gives a motion. Where the shape is given: all that the body gives to the fluid and to its own
    /// inertia, less what other loads give to it.
    template <int dim>
    double power_of_drive(const Swimmer<dim> &swimmer, const PowerBalance &balance,
                          const std::optional<LoadSum<dim>> &holding, const double body_growth,
                          const Configuration<dim> &configuration, const Rates<dim> &rates)
    {
      const Scene &scene = swimmer.scene();
      if (scene.tail && scene.tail->is_driven())
      {
        const NodalField<dim> w     = swimmer.tail_velocities(configuration, rates);
        const auto            x     = swimmer.surface(configuration);
        double                power = body_growth - balance.magnetic - balance.gravity;
        for (unsigned int k = 0; k < x.size(); ++k)
        {
          const int            node = swimmer.tail_node(k);
          const Tensor<1, dim> v =
              node >= 0 ? w[node]
                        : rates.velocity + rotational_velocity<dim>(rates.omega, x[k] - configuration.pose.center);
          for (int c = 0; c < dim; ++c)
            power += balance.surface_force[k * dim + c] * v[c];
        }
        return power;
      }
      if (!scene.head.is_driven())
        return 0.;
      double power = holding->torque * rates.omega;
      for (int c = 0; c < dim; ++c)
        power += holding->force[c] * rates.velocity[c];
      return power;
    }
  } // namespace

  template <int dim>
  PowerBalance power_balance(const Swimmer<dim> &swimmer, const FluidDomain<dim> *fluid,
                             const std::vector<double> &fluid_values, const Configuration<dim> &configuration,
                             const Rates<dim> &rates, const double time_s,
                             const std::optional<BodyVelocities<dim>> &acceleration)
  {
    PowerBalance balance;
    LoadSum<dim> of_fluid(configuration.pose.center);
    if (fluid)
    {
      const FluidReaction reaction = fluid->react(fluid_values);
      balance.dissipation          = reaction.dissipation;
      balance.wall                 = reaction.wall_power;
      balance.kinetic_energy       = reaction.kinetic.energy;
      balance.kinetic_outflow      = reaction.kinetic.outflow;
      balance.kinetic_growth       = reaction.kinetic.growth;
      balance.stabilization        = reaction.stabilization;
      for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
        for (int c = 0; c < dim; ++c)
          balance.surface_force.push_back(reaction.force[fluid->surface_row(k, c)]);
      of_fluid              = sum_of_fluid(swimmer, balance.surface_force, configuration);
      balance.load_of_fluid = of_fluid.load();
    }
    balance.magnetic = swimmer.torque_on_head(configuration.pose, time_s).torque * rates.omega;
    balance.gravity  = swimmer.force_on_head(time_s) * rates.velocity;
    if (swimmer.has_tail())
    {
      const auto w           = swimmer.tail_velocities(configuration, rates);
      balance.elastic_energy = swimmer.elasticity().energy(configuration.shape);
      for (unsigned int a = 0; a < w.size(); ++a)
      {
        const Tensor<1, dim> magnetic = swimmer.magnetic_load_on_tail_node(a, time_s);
        balance.magnetic += magnetic * w[a];
        balance.gravity += (swimmer.load_on_tail_node(a, time_s) - magnetic) * w[a];
      }
    }
    NodalField<dim> inertial_force;
    double          body_growth = 0.;
    if (acceleration)
    {
      const auto velocities = swimmer.velocities(configuration, rates);
      balance.kinetic_energy += swimmer.kinetic_energy(velocities);
      inertial_force = swimmer.inertial_force_on_tail(acceleration->tail);
      for (unsigned int a = 0; a < inertial_force.size(); ++a)
        body_growth += inertial_force[a] * velocities.tail[a];
      if (swimmer.inertia().head)
        body_growth += swimmer.head_mass() * (acceleration->head * velocities.head) +
                       swimmer.head_moment_of_inertia() * (acceleration->spin * velocities.omega);
      balance.kinetic_growth += body_growth;
    }
    std::optional<LoadSum<dim>> holding;
    if (!swimmer.scene().head.is_free())
    {
      holding = sum_that_holds(swimmer, of_fluid, inertial_force, configuration, time_s);
      if (acceleration && swimmer.inertia().head)
      {
        holding->force += swimmer.head_mass() * acceleration->head;
        holding->torque += swimmer.head_moment_of_inertia() * acceleration->spin;
      }
      balance.load_that_holds_head = holding->load();
    }
    balance.drive = power_of_drive(swimmer, balance, holding, body_growth, configuration, rates);
    return balance;
  }

  template PowerBalance power_balance<2>(const Swimmer<2> &, const FluidDomain<2> *, const std::vector<double> &,
                                         const Configuration<2> &, const Rates<2> &, double,
                                         const std::optional<BodyVelocities<2>> &);
  template PowerBalance power_balance<3>(const Swimmer<3> &, const FluidDomain<3> *, const std::vector<double> &,
                                         const Configuration<3> &, const Rates<3> &, double,
                                         const std::optional<BodyVelocities<3>> &);
} // namespace swimtwin
