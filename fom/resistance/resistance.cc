#include <fom/resistance/resistance.h>

#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <fom/resistance/fluid_rigid_system.h>
#include <fom/resistance/positive_definite.h>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  ResistanceResult<dim> compute_resistance(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                           const MPI_Comm communicator)
  {
    const Scene     &scene = swimmer.scene();
    FluidDomain<dim> fluid(scene, mesh_for_given_motions(swimmer, configuration, communicator), configuration.pose);

    LinearSolverOptions options;
    options.tolerance = 1e-13;
    options.symmetric = true;
    options.method    = scene.numerics.linear_solver;
    LinearSystem          solver(communicator, options);
    FluidRigidSystem<dim> system(swimmer, fluid, solver, true, communicator);
    if (solver.is_iterative()) // of the residual: below that a large system's is round-off
      solver.aim_at(1e-11);

    // Unit loads give the columns of the mobility.
    const auto        &motions = system.motions();
    const int          n       = motions.size();
    FullMatrix<double> mobility(n, n);
    for (int j = 0; j < n; ++j)
    {
      Tensor<1, n_rigid<dim>> unit_load;
      unit_load[motions[j]] = 1.;
      system.assemble(configuration, {}, std::nullopt);
      system.add_load(unit_load);
      std::vector<double> unknowns(system.n_unknowns(), 0.);
      if (!system.solve(unknowns))
        throw ComputationError(
            "the Stokes problem of the resistance matrix could not be solved: change [numerics] mesh_size_m");
      const auto velocity = system.rigid_velocity(unknowns);
      for (int i = 0; i < n; ++i)
        mobility(i, j) = velocity[motions[i]];
    }

    ResistanceResult<dim> result{FullMatrix<double>(n, n), 0., system.n_unknowns(), fluid.mesh().n_cells()};
    result.matrix.invert(mobility);
    result.asymmetry = largest_asymmetry(result.matrix);
    check_resistance(result.matrix, result.asymmetry);
    return result;
  }

  template struct ResistanceResult<2>;
  template struct ResistanceResult<3>;
  template ResistanceResult<2> compute_resistance<2>(const Swimmer<2> &, const Configuration<2> &, MPI_Comm);
  template ResistanceResult<3> compute_resistance<3>(const Swimmer<3> &, const Configuration<3> &, MPI_Comm);
} // namespace swimtwin
