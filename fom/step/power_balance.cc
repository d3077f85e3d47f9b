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
        const Tensor<1, dim> r = x - center_;
        force += f;
        torque += r[0] * f[1] - r[1] * f[0];
      }
      Tensor<1, dim> force;
      double         torque = 0.;

    private:
      Point<dim> center_;
    };

    /// What must hold a fixed head: the whole body is in equilibrium, and the tail's internal forces have no resultant.
    template <int dim>
    std::array<double, 3> load_that_holds(const Swimmer<dim> &swimmer, const FluidDomain<dim> *fluid,
                                          const std::vector<double> &reaction, const Configuration<dim> &configuration,
                                          const double time_s)
    {
      LoadSum<dim> sum(configuration.pose.center);
      if (fluid)
      {
        const auto x = swimmer.surface(configuration);
        for (unsigned int k = 0; k < x.size(); ++k)
        {
          Tensor<1, dim> on_fluid;
          for (int c = 0; c < dim; ++c)
            on_fluid[c] = reaction[fluid->surface_row(k, c)];
          sum.add(x[k], on_fluid);
        }
      }
      if (swimmer.has_tail())
      {
        const auto x = swimmer.tail_positions(configuration);
        for (unsigned int a = 0; a < x.size(); ++a)
          sum.add(x[a], -swimmer.load_on_tail_node(a, time_s));
      }
      const auto head   = swimmer.force_on_head(time_s);
      const auto torque = swimmer.torque_on_head(configuration.pose.angle, time_s).torque;
      return {sum.force[0] - head[0], sum.force[1] - head[1], sum.torque - torque};
    }
  } // namespace

  template <int dim>
  PowerBalance power_balance(const Swimmer<dim> &swimmer, const FluidDomain<dim> *fluid,
                             const std::vector<double> &fluid_values, const Configuration<dim> &configuration,
                             const Rates<dim> &rates, const double time_s)
  {
    PowerBalance  balance;
    FluidReaction reaction;
    if (fluid)
    {
      reaction            = fluid->react(fluid_values);
      balance.dissipation = reaction.dissipation;
      balance.wall        = reaction.wall_power;
      for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
        for (int c = 0; c < dim; ++c)
          balance.surface_force.push_back(reaction.force[fluid->surface_row(k, c)]);
    }
    balance.magnetic = swimmer.torque_on_head(configuration.pose.angle, time_s).torque * rates.omega[0];
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
    if (swimmer.scene().head.fixed)
      balance.load_that_holds_head = load_that_holds(swimmer, fluid, reaction.force, configuration, time_s);
    return balance;
  }

  template PowerBalance power_balance<2>(const Swimmer<2> &, const FluidDomain<2> *, const std::vector<double> &,
                                         const Configuration<2> &, const Rates<2> &, double);
} // namespace swimtwin
