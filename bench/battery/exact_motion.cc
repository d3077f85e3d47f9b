#include <bench/battery/exact_motion.h>

#include <datasets/system/error.h>
#include <fom/elastic/nodal_vector.h>
#include <fom/resistance/motion_resistance.h>
#include <rom/training/posed_body.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

// Letters as in docs/equations.md, sections 6 and 14.

namespace swimtwin
{
  namespace
  {
    struct ReducedLoad
    {
      Eigen::VectorXd force;
      Eigen::MatrixXd slope; ///< by the state's angle and shape; zero rows and columns for the place
    };

    ReducedLoad load(const ReducedSwimmer &swimmer, const Eigen::VectorXd &state, const RunParameters &p,
                     const double phase)
    {
      const int             n = swimmer.n_states(), r = swimmer.n_modes();
      const ShapeVector     q = state.tail(r);
      const double          s = std::sin(state[2]), c = std::cos(state[2]);
      const double          by = p.by_T * std::sin(2. * std::numbers::pi * phase);
      const Eigen::Vector2d m  = swimmer.moment(q, {p.young_modulus_Pa, p.viscosity_Pa_s, p.magnetization_A_m, 0.});
      ReducedLoad           load{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
      load.force[2]                      = m.x() * (c * by - s * p.bx_T);
      load.slope(2, 2)                   = -m.x() * (s * by + c * p.bx_T);
      load.force.tail(r)                 = -p.young_modulus_Pa * swimmer.energy().gradient(q);
      load.slope.bottomRightCorner(r, r) = -p.young_modulus_Pa * swimmer.energy().hessian(q);
      return load;
    }

    Eigen::VectorXd in_laboratory(Eigen::VectorXd velocity, const double angle)
    {
      velocity.head<2>() = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(velocity.head<2>());
      return velocity;
    }
  } // namespace

  template <int dim>
  Configuration<dim> ExactMotion<dim>::configuration(const Eigen::VectorXd &state, const ResistanceSource source) const
  {
    const ShapePoint   point{state.tail(basis_.n_coordinates()), state[2]};
    const bool         in_place = source == ResistanceSource::full_order_in_place;
    Configuration<dim> c        = posed(swimmer_, point, nodal_field<dim>(basis_.displacement(point.q)),
                                 in_place ? state[1] : place_.height_m(point));
    if (source != ResistanceSource::full_order_in_usual_place)
      c.pose.center[0] = swimmer_.configuration_at_rest().pose.center[0] + state[0];
    return c;
  }

  template <int dim>
  Eigen::MatrixXd ExactMotion<dim>::resistance(const Eigen::VectorXd &state, const ResistanceSource source)
  {
    const Eigen::VectorXd q = state.tail(basis_.n_coordinates());
    if (source == ResistanceSource::surrogate)
      return reduced_.resistance().resistance(q, state[2], state[1]);
    std::vector<NodalField<dim>> modes;
    for (const Eigen::MatrixXd tangent = basis_.tangent(q); const auto column : tangent.colwise())
      modes.push_back(nodal_field<dim>(column));
    const Configuration<dim> here = configuration(state, source);
    const auto               R    = fluid_.around(here, [&](const FluidDomain<dim> &fluid) {
      return compute_motion_resistance(swimmer_, fluid, here, modes).matrix;
    });
    Eigen::MatrixXd          result(R.m(), R.n());
    for (unsigned int i = 0; i < R.m(); ++i)
      for (unsigned int j = 0; j < R.n(); ++j)
        result(i, j) = R(i, j) / swimmer_.scene().fluid->viscosity_Pa_s;
    return result;
  }

  template <int dim>
  double ExactMotion<dim>::displacement_m(const RunParameters &p, const ResistanceSource source, const int n_periods,
                                          const int n)
  {
    constexpr double tolerance = 1e-6; // a period's displacement may be half a hundredth of the length
    const double     length = reduced_.length_m(), step_s = 1. / (p.frequency_Hz * n);
    const auto       size = [&](Eigen::VectorXd change) {
      change.head<2>() /= length;
      return change.norm();
    };
    Eigen::VectorXd now = Eigen::VectorXd::Zero(reduced_.n_states()), before = now, velocity = now, rate = now;
    Eigen::VectorXd rate_before = now;
    double          begin_x     = 0.;
    for (int k = 1; k <= n_periods * n; ++k)
    {
      const bool            first = k == 1;
      const double          c     = (first ? 1. : 2. / 3.) * step_s;
      const Eigen::VectorXd star  = first ? now : Eigen::VectorXd((4. * now - before) / 3.);
      Eigen::VectorXd       next  = star + c * (2. * rate - rate_before);
      bool                  done  = false;
      for (int iteration = 0; iteration < 25 && !done; ++iteration)
      {
        Eigen::MatrixXd R;
        try
        {
          R = p.viscosity_Pa_s * resistance(next, source);
        }
        catch (const ComputationError &error)
        {
          throw ComputationError(fmt::format("step {}, iteration {}, state {}: {}", k, iteration,
                                             fmt::join(next.data(), next.data() + next.size(), " "), error.what()));
        }
        Eigen::VectorXd at = next;
        for (int newton = 0; newton < 20; ++newton)
        {
          const ReducedLoad     f        = load(reduced_, at, p, static_cast<double>(k) / n);
          const Eigen::VectorXd residual = f.force - R * velocity;
          const Eigen::VectorXd update   = (R - c * f.slope).partialPivLu().solve(residual);
          velocity += update;
          at = star + c * in_laboratory(velocity, at[2]);
          if (size(c * update) < .01 * tolerance)
            break;
        }
        done = size(at - next) < tolerance;
        next = at;
      }
      if (!done)
        throw ComputationError(fmt::format("step {} of the exact motion finds no end", k));
      rate_before = first ? (next - now) / step_s : rate;
      rate        = (next - star) / c;
      before      = now;
      now         = next;
      if (k == (n_periods - 1) * n)
        begin_x = now[0];
    }
    return -(now[0] - begin_x);
  }

  template class ExactMotion<2>;
  template class ExactMotion<3>;
} // namespace swimtwin
