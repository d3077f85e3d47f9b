#include <fom/coupling/coupling.h>

#include <datasets/scene/inertia_terms.h>
#include <fom/coupling/fixed_point_coupling.h>
#include <fom/coupling/monolithic_coupling.h>

#include <datasets/scene/dimensionless_groups.h>

#include <fmt/ranges.h>

namespace swimtwin
{
  using namespace dealii;

  std::string cause(const StepOutcome outcome)
  {
    switch (outcome)
    {
    case StepOutcome::accepted:
      return "accepted";
    case StepOutcome::mesh_inverted:
      return "an element of the fluid's mesh was turned inside out";
    case StepOutcome::mesh_motion_failed:
      return "the linear solver failed for the motion of the fluid's mesh";
    case StepOutcome::tail_inverted:
      return "an element of the tail was turned inside out";
    case StepOutcome::coupling_diverged:
      return "the coupling iteration did not converge";
    case StepOutcome::linear_solver_failed:
      return "the linear solver failed";
    case StepOutcome::unstable_equilibrium:
      return "the field turns the head away from an unstable equilibrium in less time than the step";
    case StepOutcome::tail_equilibrium_failed:
      return "Newton's method for the tail under the fluid's load did not converge";
    }
    return "unknown";
  }

  namespace
  {
    /// The scene's own, of what may be larger than it was meant.
    std::string what_drives(const Scene &scene)
    {
      std::vector<std::string> values;
      if (scene.head.magnetization_A_m != 0. || (scene.tail && scene.tail->magnetization_A_m != 0.))
        values.insert(values.end(), {"the field", "magnetization_A_m"});
      if (scene.gravity.acceleration_m_s2 != decltype(scene.gravity.acceleration_m_s2){})
        values.emplace_back("[gravity]");
      if (largest_imposed_speed_m_s(scene) > 0.)
        values.emplace_back("the imposed speeds");
      if (scene.tail && scene.tail->is_elastic())
        values.emplace_back("young_modulus_Pa");
      return fmt::format("{}", fmt::join(values, ", "));
    }

    std::string are_small_enough(const Scene &scene)
    {
      return fmt::format("; swimtwin plan says whether {} are small enough for the flow's speed",
                         scene.time.is_steady ? "cells" : "cells and steps");
    }

    std::string finer_mesh(const Scene &scene)
    {
      return scene.head.surface ? "mesh the body's surface finer" : "refine [numerics] mesh_size_m";
    }
  } // namespace

  std::string shorter_steps(const Scene &scene)
  {
    return scene.time.is_steady ? "leave out [time] steady and follow it in time"
                                : "raise [time] steps_per_period (or steps)";
  }

  std::string remedy(const StepOutcome outcome, const Scene &scene)
  {
    switch (outcome)
    {
    case StepOutcome::mesh_inverted:
      return finer_mesh(scene) + " or " + shorter_steps(scene) +
             "; if the body comes close to a wall or to itself, "
             "contact is not modelled";
    case StepOutcome::tail_inverted:
    case StepOutcome::tail_equilibrium_failed:
      if (scene.tail->is_driven())
        return "the bending of [tail.wave] turns elements inside out: lower its angle_rad or its number of waves";
      return scene.tail->law == MaterialModel::st_venant_kirchhoff
                 ? "the tail is compressed beyond what the St Venant-Kirchhoff law can bear, or the step is too long: "
                   "use [tail] law = \"neo-hookean\", " +
                       shorter_steps(scene) + ", or check " + what_drives(scene)
                 : shorter_steps(scene) + ", or check " + what_drives(scene);
    case StepOutcome::unstable_equilibrium:
      return "raise [time] steps_per_period or [numerics] max_step_halvings, or check magnetization_A_m and the field";
    case StepOutcome::coupling_diverged: {
      const bool has_speed = scene.fluid && inertia_terms(scene).of_fluid();
      return fmt::format("{}, or check that the scene's values are what you meant ({}){}", shorter_steps(scene),
                         what_drives(scene), has_speed ? are_small_enough(scene) : "");
    }
    default:
      return finer_mesh(scene) + ", or check that the scene's values are what you meant";
    }
  }

  template <int dim>
  StepOutcome move_meshes(FluidDomain<dim> *fluid, const Swimmer<dim> &swimmer, const Configuration<dim> &configuration)
  {
    if (fluid)
    {
      const auto quality = fluid->follow(swimmer.surface(configuration), configuration.pose);
      if (!quality)
        return StepOutcome::mesh_motion_failed;
      if (!(*quality > 0.))
        return StepOutcome::mesh_inverted;
    }
    return swimmer.has_tail() && swimmer.elasticity().is_inverted(configuration.shape) ? StepOutcome::tail_inverted
                                                                                       : StepOutcome::accepted;
  }

  template <int dim>
  std::unique_ptr<Coupling<dim>> make_coupling(const Swimmer<dim> &swimmer, const MPI_Comm communicator)
  {
    if (swimmer.scene().is_partitioned())
      return std::make_unique<FixedPointCoupling<dim>>(swimmer, communicator);
    return std::make_unique<MonolithicCoupling<dim>>(swimmer, communicator);
  }

  template <int dim>
  Point<dim> head_center(const Swimmer<dim> &swimmer, const TimeStep<dim> &step,
                         const Configuration<dim> &configuration, const Rates<dim> &rates)
  {
    const Tensor<2, dim> R   = configuration.pose.rotation();
    const Tensor<1, dim> arm = R * swimmer.arm_to_middle(configuration.shape);
    const Tensor<1, dim> velocity_of_middle =
        rates.velocity + rotational_velocity<dim>(rates.omega, arm) + R * swimmer.rate_of_arm(rates.shape_rate);
    return step.known.pose.center + step.slope_weight * velocity_of_middle - arm;
  }

  LinearSolverOptions solver_options(const Numerics &numerics, const int dimension)
  {
    LinearSolverOptions options;
    if (dimension == 3) // 18 measured at 29,000 unknowns of a half
    {
      options.factorization_effort = 18;
      options.max_stale_iterations = 40;
    }
    options.tolerance           = numerics.linear_tolerance;
    options.reuse_factorization = numerics.reuse_factorization;
    options.method              = numerics.linear_solver;
    options.symmetric           = true; // every system of the form P^T A P here is
    return options;
  }

  std::vector<double> extrapolate(const std::vector<double> &now, const std::vector<double> &before,
                                  const double growth)
  {
    std::vector<double> next = now;
    if (!before.empty())
      for (std::size_t i = 0; i < next.size(); ++i)
        next[i] += growth * (now[i] - before[i]);
    return next;
  }

  template Point<2> head_center<2>(const Swimmer<2> &, const TimeStep<2> &, const Configuration<2> &, const Rates<2> &);
  template Point<3> head_center<3>(const Swimmer<3> &, const TimeStep<3> &, const Configuration<3> &, const Rates<3> &);
  template StepOutcome                  move_meshes<2>(FluidDomain<2> *, const Swimmer<2> &, const Configuration<2> &);
  template StepOutcome                  move_meshes<3>(FluidDomain<3> *, const Swimmer<3> &, const Configuration<3> &);
  template std::unique_ptr<Coupling<2>> make_coupling<2>(const Swimmer<2> &, MPI_Comm);
  template std::unique_ptr<Coupling<3>> make_coupling<3>(const Swimmer<3> &, MPI_Comm);
} // namespace swimtwin
