#include <fom/step/start_work.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Where the body's parts are at two instants.
    template <int dim>
    struct Way
    {
      const Swimmer<dim> &swimmer;
      const Instant<dim> &before, &now;

      AngularVelocity<dim> turn() const { return now.configuration.pose.turn_from(before.configuration.pose); }
      Tensor<1, dim>       of_head() const { return now.configuration.pose.center - before.configuration.pose.center; }
      std::vector<Tensor<1, dim>> of_tail() const
      {
        return difference(swimmer.tail_positions(now.configuration), swimmer.tail_positions(before.configuration));
      }
      std::vector<Tensor<1, dim>> of_surface() const
      {
        return difference(swimmer.surface(now.configuration), swimmer.surface(before.configuration));
      }

    private:
      static std::vector<Tensor<1, dim>> difference(const std::vector<Point<dim>> &a, const std::vector<Point<dim>> &b)
      {
        std::vector<Tensor<1, dim>> result;
        for (unsigned int i = 0; i < a.size(); ++i)
          result.push_back(a[i] - b[i]);
        return result;
      }
    };

    struct LoadWork
    {
      double magnetic = 0., gravity = 0.;
    };

    /// Of the loads of one of the instants along the way between both.
    template <int dim>
    LoadWork work_of_loads(const Way<dim> &way, const Instant<dim> &at)
    {
      const Swimmer<dim> &swimmer = way.swimmer;
      LoadWork            work{swimmer.torque_on_head(at.configuration.pose, at.time_s).torque * way.turn(),
                    swimmer.force_on_head(at.time_s) * way.of_head()};
      const auto          tail = way.of_tail();
      for (unsigned int a = 0; a < tail.size(); ++a)
      {
        const Tensor<1, dim> magnetic = swimmer.magnetic_load_on_tail_node(a, at.time_s);
        work.magnetic += magnetic * tail[a];
        work.gravity += (swimmer.load_on_tail_node(a, at.time_s) - magnetic) * tail[a];
      }
      return work;
    }

    template <int dim>
    double work_of_surface(const std::vector<double> &force, const std::vector<Tensor<1, dim>> &way)
    {
      double work = 0.;
      for (unsigned int k = 0; k < way.size(); ++k)
        for (int c = 0; c < dim; ++c)
          work += force[k * dim + c] * way[k][c];
      return work;
    }

    bool walls_move_at_once(const Domain &domain)
    {
      return std::any_of(domain.walls.begin(), domain.walls.end(),
                         [](const auto &wall) { return wall.second.speed_m_s != 0. && wall.second.ramp_s == 0.; });
    }

    template <int dim>
    bool tail_is_loaded(const Swimmer<dim> &swimmer)
    {
      for (unsigned int a = 0; a < swimmer.tail().mesh.n_nodes(); ++a)
        if (swimmer.load_on_tail_node(a, 0.).norm() > 0.)
          return true;
      return false;
    }

    template <int dim>
    bool head_is_turned(const Swimmer<dim> &swimmer)
    {
      constexpr double round_off = 1e-12; // of sines: a head along the field is not turned
      const Scene     &scene     = swimmer.scene();
      const auto       field     = scene.field(0.);
      const double     largest =
          scene.head.magnetization_A_m * scene.head.volume(dim) * std::hypot(field[0], field[1], field[2]);
      return scene.head.is_free() &&
             swimmer.torque_on_head(swimmer.pose_at_rest(), 0.).torque.norm() > round_off * std::abs(largest);
    }
  } // namespace

  int n_start_steps(const TimeSettings &time)
  {
    return std::max(1, time.steps_per_period / 10);
  }

  template <int dim>
  bool starts_under_load(const Swimmer<dim> &swimmer)
  {
    const Scene &scene     = swimmer.scene();
    const bool   is_driven = scene.head.is_driven() || (scene.tail && scene.tail->is_driven());
    return scene.fluid && swimmer.has_tail() && !is_driven &&
           (head_is_turned(swimmer) || tail_is_loaded(swimmer) || swimmer.force_on_head(0.).norm() > 0. ||
            walls_move_at_once(*scene.domain));
  }

  bool powers_are_smooth_again(const PowerBalance &before, const PowerBalance &now)
  {
    const auto put_in = [](const PowerBalance &b) { return std::abs(b.magnetic + b.gravity + b.wall); };
    return put_in(now) > put_in(before);
  }

  template <int dim>
  IntervalWork work_along_the_way(const Swimmer<dim> &swimmer, const Instant<dim> &before,
                                  const PowerBalance *balance_before, const Instant<dim> &now,
                                  const PowerBalance &balance)
  {
    const Way<dim> way{swimmer, before, now};
    const LoadWork loads_before = work_of_loads(way, before), loads = work_of_loads(way, now);
    const auto     surface         = way.of_surface();
    const double   on_fluid_before = balance_before
                                         ? work_of_surface<dim>(balance_before->surface_force, surface)
                                         : loads_before.magnetic + loads_before.gravity; // the tail is not strained yet
    const double   on_fluid        = work_of_surface<dim>(balance.surface_force, surface);
    const double   walls =
        (now.time_s - before.time_s) * .5 * (balance.wall + (balance_before ? *balance_before : balance).wall);
    return {.5 * (loads_before.magnetic + loads.magnetic), .5 * (loads_before.gravity + loads.gravity) + walls,
            .5 * (on_fluid_before + on_fluid) + walls};
  }

  template bool         starts_under_load<2>(const Swimmer<2> &);
  template bool         starts_under_load<3>(const Swimmer<3> &);
  template IntervalWork work_along_the_way<2>(const Swimmer<2> &, const Instant<2> &, const PowerBalance *,
                                              const Instant<2> &, const PowerBalance &);
  template IntervalWork work_along_the_way<3>(const Swimmer<3> &, const Instant<3> &, const PowerBalance *,
                                              const Instant<3> &, const PowerBalance &);
} // namespace swimtwin
