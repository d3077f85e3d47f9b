#include <fom/run/run_plan.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/scene/swimmer_clearance.h>
#include <datasets/surface/closed_surface.h>
#include <fom/algebra/linear_system.h>
#include <fom/algebra/solver_memory.h>
#include <fom/body/mesh_around.h>
#include <fom/fluid/streamline_stabilization.h>
#include <fom/step/full_order_model.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    /// One core, MUMPS with OpenBLAS: CPU time per coupling iteration and memory against unknowns. 2D: as measured by
    /// bench/work-precision on the shipped reference scene; 3D: by bench/three-dimensions/costs, from 18,000 to
    /// 87,000 unknowns (docs/benchmarks.md, docs/study.md). Both halves of a body in space fill their factors more than
    /// one does.
    double seconds_per_iteration(const double n_unknowns, const Scene &scene)
    {
      if (scene.dimension == 2)
        return 0.0205 * std::pow(n_unknowns / 7400., 1.2);
      return (solves_half(scene) ? 0.37 : 0.52) * std::pow(n_unknowns / 29e3, 1.4);
    }
    double memory_MB(const double n_unknowns, const int dimension, const bool iterative)
    {
      const double beside_system = dimension == 3 ? 1.2 : 1.;
      return beside_system * (process_memory_MB + system_memory_MB(n_unknowns, dimension, iterative));
    }
    /// Of a monolithic step, and of fixed-point iterations, which take from 5 to 15 times as long.
    double iterations_per_step(const Scene &scene)
    {
      if (scene.is_partitioned())
        return 15.;
      if (!scene.fluid || !inertia_terms(scene).of_fluid())
        return 1.5;
      return scene.dimension == 3 ? 2. : 1.7;
    }
    /// Largest sizes that were measured: docs/stress.md, and above.
    double n_unknowns_measured(const int dimension)
    {
      return dimension == 3 ? 87e3 : 210e3;
    }

    /// Of the tail's tip when the swimmer follows the field's direction.
    double speed_of_swing(const Scene &scene)
    {
      constexpr int n_instants = 64;
      if (!scene.head.is_free() || scene.head.magnetization_A_m == 0. || scene.time.period_s <= 0.)
        return 0.;
      double most = 0., least = 0.;
      for (int i = 0; i < n_instants; ++i)
      {
        const auto   field = scene.field(i * scene.time.period_s / n_instants);
        const double angle = std::atan2(field[1], field[0]);
        most = std::max(most, angle), least = std::min(least, angle);
      }
      return std::numbers::pi * (most - least) * scene.body_length_m() / scene.time.period_s;
    }

    /// A swimmer that the field throws about rather than turns.
    void warn_of_swing(const Scene &scene, RunPlan &plan)
    {
      constexpr double swings = 0.4, longest_step_rad = 1.25, good_step_rad = 0.6;
      const auto [rate, damping_ratio] = magnetic_swing(scene);
      const double step_rad            = rate * scene.time.time_step_s();
      if (!scene.head.is_free() || damping_ratio > swings || step_rad < longest_step_rad)
        return;
      plan.warnings.push_back(fmt::format(
          "inertia lets the swimmer swing about the field at {:.3g} Hz by itself, which {:.2g} steps per swing do not "
          "follow; raise [time] steps_per_period to {:.0f}",
          rate / (2. * std::numbers::pi), 2. * std::numbers::pi / step_rad,
          std::ceil(scene.time.steps_per_period * step_rad / good_step_rad)));
    }

    /// Scenes whose inertia the scheme may not hold.
    void warn_of_inertia(const Scene &scene, RunPlan &plan)
    {
      constexpr double resolved = StreamlineStabilization<2>::largest_resolved_reynolds_number;
      // The estimate is of the largest cell at the largest speed, which do not meet.
      constexpr double largest_cell_reynolds_number = 2. * resolved, largest_way_per_step = 0.2, far_enough = 2.5;
      const auto      &fluid = *scene.fluid;
      const double     L     = scene.body_length_m();
      const double     speed = std::max(largest_imposed_speed_m_s(scene), speed_of_swing(scene));
      if (const double cell = fluid.density_kg_m3 * speed * scene.numerics.mesh_size_far_m / fluid.viscosity_Pa_s;
          cell > largest_cell_reynolds_number)
        plan.warnings.push_back(
            fmt::format("the Reynolds number of a cell is up to {:.3g}: above {:g} a dissipation that costs accuracy "
                        "keeps the flow smooth; lower [numerics] mesh_size_far_m = {:g} m",
                        cell, resolved, scene.numerics.mesh_size_far_m));
      if (const double way = speed * scene.time.time_step_s() / L; !scene.time.is_steady && way > largest_way_per_step)
        plan.warnings.push_back(
            fmt::format("the fluid goes {:.3g} body lengths per step: above {:g} the steps do not see what "
                        "it does; raise the number of steps",
                        way, largest_way_per_step));
      const double penetration =
          std::sqrt(fluid.viscosity_Pa_s * scene.time.period_s / (std::numbers::pi * fluid.density_kg_m3));
      if (scene.domain->moves_with_swimmer && scene.domain->radius_m < far_enough * (L + penetration))
        plan.warnings.push_back(
            fmt::format("the outer wall moves along with the swimmer, which the fluid's inertia feels at "
                        "{:g} m: vorticity reaches {:.2g} m beyond the body; enlarge [domain] radius_m",
                        scene.domain->radius_m, penetration));
      warn_of_swing(scene, plan);
    }

    void plan_inertia(const Scene &scene, RunPlan &plan, const double unsteady_group)
    {
      const InertiaTerms terms       = inertia_terms(scene);
      const auto [fluid, tail, head] = inertia_shares(scene);
      if (scene.time.period_s > 0. && !scene.time.is_steady)
        plan.numbers.push_back(
            {"inertia", fmt::format("estimated share of the displacement: fluid {:.2g} %, tail {:.2g} %, "
                                    "head {:.2g} %; \"auto\" keeps what is above {:.1g} %",
                                    100. * fluid, 100. * tail, 100. * head, 100. * negligible_share)});
      if (scene.time.is_steady && terms.of_fluid())
        plan.solved.push_back({"fluid inertia", "convective term, of a steady state"});
      else if (terms.unsteady)
        plan.solved.push_back({"fluid inertia", terms.convective ? "unsteady and convective terms, ALE, BDF2"
                                                                 : "unsteady term alone, ALE, BDF2"});
      else if (terms.convective)
        plan.solved.push_back({"fluid inertia", "convective term alone"});
      else
        plan.skipped.push_back({"fluid inertia", fmt::format("left out; unsteady group {:.2g}", unsteady_group)});
      if (terms.head)
        plan.solved.push_back({"head's inertia", "mass and moment of inertia"});
      if (terms.of_fluid())
        warn_of_inertia(scene, plan);
    }

    void plan_fluid(const Scene &scene, RunPlan &plan)
    {
      if (!scene.fluid)
      {
        plan.skipped.push_back(
            {"fluid", "the scene has none: the tail is in equilibrium with its loads at every instant"});
        return;
      }
      plan.solved.push_back({"fluid", fmt::format("{} flow, P2/P1 {} with second-order geometry",
                                                  inertia_terms(scene).convective ? "Navier-Stokes" : "Stokes",
                                                  scene.dimension == 3 ? "tetrahedra" : "triangles")});
      const double group = unsteady_group(scene);
      plan.numbers.push_back({"unsteady group", fmt::format("2 pi rho f L^2 / mu = {:.3g}{}", group,
                                                            scene.field.period_s() > 0. ? "" : ", f one per run")});
      plan_inertia(scene, plan, group);
      if (const std::string warning = inertia_warning(scene); !warning.empty())
        plan.warnings.push_back(warning);
    }

    void plan_body(const Scene &scene, RunPlan &plan)
    {
      const char *const velocities = scene.dimension == 3 && !moves_in_plane(scene) ? "six" : "three";
      if (!scene.tail)
        plan.skipped.push_back(
            {"elasticity", fmt::format("the body has no tail: one rigid body with {} velocities", velocities)});
      else if (scene.tail->is_rigid())
        plan.skipped.push_back(
            {"elasticity", fmt::format("the tail is rigid: one body with {} velocities", velocities)});
      else if (scene.tail->is_driven())
        plan.skipped.push_back({"elasticity", "the tail's shape is given at every instant"});
      else
      {
        plan.solved.push_back(
            {"tail", fmt::format("{}, P{} displacement, total Lagrangian",
                                 scene.tail->law == MaterialModel::neo_hookean ? "compressible neo-Hookean"
                                                                               : "St Venant-Kirchhoff",
                                 scene.numerics.tail_order)});
        if (inertia_terms(scene).tail)
          plan.solved.push_back({"tail's inertia", "consistent mass, BDF2"});
        else
          plan.skipped.push_back({"tail's inertia", "the tail is in equilibrium with its loads at every instant"});
        if (scene.fluid && scene.time.period_s > 0.)
          plan.numbers.push_back({"elastic group", fmt::format("{} = {:.3g}",
                                                               scene.dimension == 2 ? "E h^3 / (12 (1 - nu^2) mu f L^3)"
                                                               : scene.tail->section == TailSection::rectangular
                                                                   ? "E w h^3 / (12 pi mu f L^4)"
                                                                   : "E h^4 / (64 mu f L^4)",
                                                               elastic_group(scene))});
      }
      if (scene.head.is_driven())
        plan.skipped.push_back({"head's motion", "given; the force and torque that drive it are reported"});
      else if (!scene.head.is_free())
        plan.skipped.push_back({"head's motion", "fixed; the force and torque that hold it are reported"});
      else
        plan.solved.push_back(
            {"head", fmt::format("rigid, {} velocities, eliminated on its surface by the motion map", velocities)});
      const bool magnetic = scene.field.waveform() != FieldProgram::Waveform::none &&
                            (scene.head.magnetization_A_m != 0. || (scene.tail && scene.tail->magnetization_A_m != 0.));
      if (!magnetic)
        plan.skipped.push_back({"magnetic terms", "no field, or nothing magnetised"});
      else if (scene.fluid && scene.head.magnetization_A_m != 0.)
        plan.numbers.push_back(
            {"magnetic group",
             fmt::format("{} = {:.3g}", scene.dimension == 3 ? "M V B / (mu f L^3)" : "M A B / (mu f L^2)",
                         magnetic_group(scene))});
    }

    void plan_mesh(const Scene &scene, RunPlan &plan)
    {
      if (!scene.fluid)
        return;
      const bool body_is_still = scene.head.motion == HeadMotion::fixed && !scene.tail;
      const bool moves_along   = scene.domain->moves_with_swimmer && !scene.tail;
      if (body_is_still || moves_along)
        plan.skipped.push_back(
            {"mesh motion", body_is_still ? "nothing moves" : "the domain moves with the rigid body"});
      else
      {
        const bool iterates = scene.is_partitioned() && scene.numerics.linear_solver == LinearSolver::iterative;
        plan.solved.push_back({"mesh motion", std::string("an extension from the mesh as it was made: one ") +
                                                  (iterates ? "preconditioner" : "factorisation") + " per mesh"});
        plan.solved.push_back(
            {"remeshing",
             scene.numerics.remesh_every_steps > 0
                 ? fmt::format("every {} steps, and below quality {}", scene.numerics.remesh_every_steps,
                               scene.numerics.remesh_quality)
                 : fmt::format("only when an element's quality falls below {}", scene.numerics.remesh_quality)});
      }
      if (scene.numerics.reuse_factorization)
        plan.skipped.push_back(
            {"factorisations", "old factors precondition GMRES while that is cheaper than new ones"});
      else if (scene.numerics.linear_solver != LinearSolver::iterative)
        plan.skipped.push_back({"half of every factorisation", "the coupled matrix is symmetric"});
      if (scene.is_partitioned())
        plan.solved.push_back(
            {"coupling",
             fmt::format("fixed point, {}, until the residual is below {:.0e} body lengths",
                         scene.numerics.acceleration == AccelerationMethod::aitken ? "Aitken's relaxation" : "IQN-ILS",
                         scene.numerics.coupling_tolerance)});
      else
        plan.skipped.push_back(
            {"coupling iterations", fmt::format("a step ends when its estimated error is below {:.0e} body lengths",
                                                scene.numerics.coupling_tolerance)});
    }

    void plan_symmetry(const Scene &scene, RunPlan &plan)
    {
      const MirrorPlane plane = find_mirror_plane(scene);
      if (solves_half(scene))
      {
        plan.skipped.push_back(
            scene.dimension == 3
                ? PlanItem{"half behind", "body and field are mirrored in z = 0: z > 0 is solved and reflected"}
                : PlanItem{"lower half", "the scene has a mirror plane: the upper half is solved and reflected"});
        if (const std::string warning = symmetry_warning(scene); !warning.empty())
          plan.warnings.push_back(warning);
      }
      else if (plane.exists())
        plan.solved.push_back(
            {"both halves",
             fmt::format("the scene has a mirror plane, but {}",
                         scene.numerics.symmetric_half == SymmetricHalf::off ? "[numerics] symmetric_half = \"off\""
                         : scene.is_partitioned() ? "coupling = \"fixed-point\" does not use it"
                                                  : plane.doubt)});
      else
        plan.solved.push_back({"both halves", "no mirror plane: " + plane.missing});
    }

    /// How near the walls are; in space also what that means for the mesh, which is no finer in a gap.
    void plan_gap(const Scene &scene, RunPlan &plan)
    {
      constexpr double narrow = 0.25;
      if (!scene.domain)
        return;
      const Clearance clearance = swimmer_clearance(scene);
      const double    gap_m     = clearance.distance_m;
      plan.numbers.push_back({"nearest wall", fmt::format("{}, {:.3g} m away", clearance.wall, gap_m)});
      if (scene.dimension == 3 && gap_m < narrow * scene.numerics.mesh_size_m)
        plan.warnings.push_back(fmt::format(
            "{} is {:.2g} times narrower than elements beside it are long: the flow in it is coarse; {}, or "
            "widen the gap",
            gap_in_words(clearance), scene.numerics.mesh_size_m / gap_m,
            scene.head.surface ? "mesh the surface finer" : "lower [numerics] mesh_size_m"));
    }

    void plan_surface(const std::string &whose, const ClosedSurface &surface, RunPlan &plan)
    {
      const TriangleSizes sizes = triangle_sizes(surface);
      const std::string   file  = surface.file.filename().string();
      plan.numbers.push_back(
          {whose + " surface",
           fmt::format("{}: {} {} triangles, edges of {:.3g} m in the mean and {:.3g} m at most, worst quality {:.2g}; "
                       "encloses {:.6g} m^3",
                       file, surface.faces.size(), surface.is_curved ? "curved" : "straight", sizes.mean_edge_m,
                       sizes.longest_edge_m, sizes.worst_quality, enclosed_volume(surface).volume_m3)});
    }

    void plan_surfaces(const Scene &scene, RunPlan &plan)
    {
      if (scene.head.surface)
        plan_surface("body's", *scene.head.surface, plan);
      if (scene.domain && scene.domain->surface)
        plan_surface("walls'", *scene.domain->surface, plan);
      for (const std::string &warning : sliver_warnings(scene))
        plan.warnings.push_back(warning);
    }

    /// Mesh the scene at rest and count.
    template <int dim>
    void measure(const Scene &scene, const MPI_Comm communicator, RunPlan &plan)
    {
      const Swimmer<dim>                swimmer(scene, communicator);
      std::unique_ptr<FluidDomain<dim>> fluid;
      if (scene.fluid)
      {
        const auto rest = swimmer.configuration_at_rest();
        fluid = std::make_unique<FluidDomain<dim>>(scene, mesh_around(swimmer, rest, communicator), rest.pose);
        plan.n_fluid_cells = fluid->mesh().n_cells();
        plan.mesh_quality  = fluid->quality();
        if (plan.mesh_quality < scene.numerics.remesh_quality)
          plan.warnings.push_back(fmt::format(
              "the mesh at rest has an element of quality {:.2f}, below [numerics] remesh_quality = {}: the "
              "flow is coarse "
              "there, and the run remeshes when the quality has halved; lower mesh_growth or {}",
              plan.mesh_quality, scene.numerics.remesh_quality,
              scene.head.surface ? "mesh the surface anew" : "mesh_size_m"));
      }
      if (swimmer.has_tail())
        plan.n_tail_cells = swimmer.tail().mesh.n_cells();
      const auto coupling = make_coupling(swimmer, communicator);
      coupling->use_fluid(fluid.get());
      plan.n_unknowns = coupling->n_unknowns();
    }
  } // namespace

  namespace
  {
    void plan_solver(const Scene &scene, const bool iterative, RunPlan &plan)
    {
      const bool        is_chosen = scene.numerics.linear_solver != LinearSolver::automatic;
      const std::string why =
          is_chosen ? std::string("[numerics] linear_solver")
          : scene.is_partitioned()
              ? std::string("[numerics] coupling = \"fixed-point\"")
              : fmt::format("{} {} unknowns{}", iterative ? "more than" : "at most", unknowns_for_iterations,
                            scene.dimension == 3 ? "" : " in space, any number in the plane");
      const char *const how = !iterative ? "factors"
                              : scene.is_partitioned()
                                  ? "FGMRES with blocks by physics (fluid and rigid motion), GMRES "
                                    "with GASM (tail), CG with GAMG (mesh motion)"
                                  : "FGMRES, blocks by physics";
      plan.solved.push_back({"linear systems", fmt::format("{}: {}", how, why)});
    }
  } // namespace

  RunPlan plan_run(const Scene &scene, const MPI_Comm communicator)
  {
    RunPlan plan;
    plan_fluid(scene, plan);
    plan_body(scene, plan);
    plan_mesh(scene, plan);
    plan_symmetry(scene, plan);
    plan_gap(scene, plan);
    plan_surfaces(scene, plan);
    if (scene.output.fields_per_period == 0)
      plan.skipped.push_back({"field output", "[output] fields_per_period = 0"});

    if (scene.dimension == 3)
      measure<3>(scene, communicator, plan);
    else
      measure<2>(scene, communicator, plan);
    plan.estimated_time_s =
        scene.time.n_steps() * iterations_per_step(scene) * seconds_per_iteration(plan.n_unknowns, scene);
    const bool iterative =
        scene.fluid &&
        (scene.is_partitioned() ? scene.numerics.linear_solver == LinearSolver::iterative
                                : iterates(scene.numerics.linear_solver, scene.dimension, plan.n_unknowns));
    plan.estimated_memory_MB = memory_MB(plan.n_unknowns, scene.dimension, iterative);
    plan_solver(scene, iterative, plan);
    plan.is_extrapolated = plan.n_unknowns > n_unknowns_measured(scene.dimension);
    return plan;
  }
} // namespace swimtwin
