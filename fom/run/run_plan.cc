#include <fom/run/run_plan.h>

#include <datasets/inertia_terms.h>
#include <datasets/mirror_plane.h>
#include <fom/algebra/solver_memory.h>
#include <fom/body/mesh_around.h>
#include <fom/step/full_order_model.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// One core, 2D, MUMPS with OpenBLAS: CPU time per coupling iteration and memory against unknowns, as measured by
    /// bench/work_precision on the shipped reference scene (docs/benchmarks.md).
    double seconds_per_iteration(const double n_unknowns)
    {
      return 0.028 * std::pow(n_unknowns / 7400., 1.2);
    }
    double memory_MB(const double n_unknowns)
    {
      return process_memory_MB + memory_per_unknown_MB * n_unknowns;
    }
    constexpr double iterations_per_step = 1.5;
    constexpr double n_unknowns_measured = 210e3; ///< docs/stress.md

    void plan_inertia(const Scene &scene, RunPlan &plan, const double unsteady_group)
    {
      const InertiaTerms terms = inertia_terms(scene);
      if (terms.unsteady)
        plan.solved.push_back({"fluid inertia", terms.convective ? "unsteady and convective terms, ALE, BDF2"
                                                                 : "unsteady term alone, ALE, BDF2"});
      else if (terms.convective)
        plan.solved.push_back({"fluid inertia", "convective term alone"});
      else
        plan.skipped.push_back(
            {"fluid inertia",
             fmt::format("left out; relative size of what is neglected: up to {:.2g}", unsteady_group)});
      if (terms.head)
        plan.solved.push_back({"head's inertia", "mass and moment of inertia"});
    }

    void plan_fluid(const Scene &scene, RunPlan &plan)
    {
      if (!scene.fluid)
      {
        plan.skipped.push_back(
            {"fluid", "the scene has none: the tail is in equilibrium with its loads at every instant"});
        return;
      }
      plan.solved.push_back({"fluid", fmt::format("{} flow, P2/P1 triangles with second-order geometry",
                                                  inertia_terms(scene).convective ? "Navier-Stokes" : "Stokes")});
      const double group = unsteady_group(scene);
      plan.numbers.push_back({"unsteady group", fmt::format("2 pi rho f L^2 / mu = {:.3g}{}", group,
                                                            scene.field.period_s() > 0. ? "" : ", f one per run")});
      plan_inertia(scene, plan, group);
      if (const std::string warning = inertia_warning(scene); !warning.empty())
        plan.warnings.push_back(warning);
    }

    void plan_body(const Scene &scene, RunPlan &plan)
    {
      if (!scene.tail)
        plan.skipped.push_back({"elasticity", "the body has no tail: one rigid body with three velocities"});
      else if (scene.tail->is_rigid())
        plan.skipped.push_back({"elasticity", "the tail is rigid: one body with three velocities"});
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
          plan.numbers.push_back(
              {"elastic group", fmt::format("E h^3 / (12 (1 - nu^2) mu f L^3) = {:.3g}", elastic_group(scene))});
      }
      if (scene.head.fixed)
        plan.skipped.push_back({"head's motion", "fixed; the force and torque that hold it are reported"});
      else
        plan.solved.push_back({"head", "rigid, three velocities, eliminated on its surface by the motion map"});
      const bool magnetic = scene.field.waveform() != FieldProgram::Waveform::none &&
                            (scene.head.magnetization_A_m != 0. || (scene.tail && scene.tail->magnetization_A_m != 0.));
      if (!magnetic)
        plan.skipped.push_back({"magnetic terms", "no field, or nothing magnetised"});
      else if (scene.fluid && scene.head.magnetization_A_m != 0.)
        plan.numbers.push_back({"magnetic group", fmt::format("M A B / (mu f L^2) = {:.3g}", magnetic_group(scene))});
    }

    void plan_mesh(const Scene &scene, RunPlan &plan)
    {
      if (!scene.fluid)
        return;
      const bool body_is_still = scene.head.fixed && !scene.tail;
      const bool moves_along   = scene.domain->moves_with_swimmer && !scene.tail;
      if (body_is_still || moves_along)
        plan.skipped.push_back(
            {"mesh motion", body_is_still ? "nothing moves" : "the domain moves with the rigid body"});
      else
      {
        plan.solved.push_back({"mesh motion", "an extension from the mesh as it was made: one factorisation per mesh"});
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
      else
        plan.skipped.push_back({"half of every factorisation", "the coupled matrix is symmetric"});
      if (is_partitioned(scene))
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
        plan.skipped.push_back({"lower half", "the scene has a mirror plane: the upper half is solved and reflected"});
        if (const std::string warning = symmetry_warning(scene); !warning.empty())
          plan.warnings.push_back(warning);
      }
      else if (plane.exists())
        plan.solved.push_back(
            {"both halves",
             fmt::format("the scene has a mirror plane, but {}",
                         scene.numerics.symmetric_half == SymmetricHalf::off ? "[numerics] symmetric_half = \"off\""
                         : is_partitioned(scene) ? "coupling = \"fixed-point\" does not use it"
                                                 : plane.doubt)});
      else
        plan.solved.push_back({"both halves", "no mirror plane: " + plane.missing});
    }
  } // namespace

  RunPlan plan_run(const Scene &scene, const MPI_Comm communicator)
  {
    RunPlan plan;
    plan_fluid(scene, plan);
    plan_body(scene, plan);
    plan_mesh(scene, plan);
    plan_symmetry(scene, plan);
    if (scene.output.fields_per_period == 0)
      plan.skipped.push_back({"field output", "[output] fields_per_period = 0"});

    const Swimmer<2>                swimmer(scene, communicator);
    std::unique_ptr<FluidDomain<2>> fluid;
    if (scene.fluid)
    {
      const auto rest    = swimmer.configuration_at_rest();
      fluid              = std::make_unique<FluidDomain<2>>(scene, mesh_around(swimmer, rest, communicator), rest.pose);
      plan.n_fluid_cells = fluid->mesh().n_cells();
      plan.mesh_quality  = fluid->quality();
      if (plan.mesh_quality < scene.numerics.remesh_quality)
        plan.warnings.push_back(
            fmt::format("the mesh at rest has an element of quality {:.2f}, below [numerics] remesh_quality = {}: the "
                        "flow is coarse "
                        "there, and the run remeshes when the quality has halved; lower mesh_growth or mesh_size_m",
                        plan.mesh_quality, scene.numerics.remesh_quality));
    }
    if (swimmer.has_tail())
      plan.n_tail_cells = swimmer.tail().mesh.n_cells();
    const auto coupling = make_coupling(swimmer, communicator);
    coupling->use_fluid(fluid.get());
    plan.n_unknowns          = coupling->n_unknowns();
    plan.estimated_time_s    = scene.time.n_steps() * iterations_per_step * seconds_per_iteration(plan.n_unknowns);
    plan.estimated_memory_MB = memory_MB(plan.n_unknowns);
    plan.is_extrapolated     = plan.n_unknowns > n_unknowns_measured;
    return plan;
  }
} // namespace swimtwin
