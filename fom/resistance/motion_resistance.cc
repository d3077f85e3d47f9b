#include <fom/resistance/motion_resistance.h>

#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <fom/resistance/positive_definite.h>
#include <fom/resistance/surface_problem.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Rows and columns of the motions that move the surface: one of the tail's inside alone leaves the fluid at rest.
    template <int dim>
    FullMatrix<double> felt_by_the_fluid(const FullMatrix<double>                &resistance,
                                         const std::vector<SurfaceVelocity<dim>> &motions)
    {
      std::vector<unsigned int> felt;
      for (unsigned int i = 0; i < motions.size(); ++i)
        if (std::any_of(motions[i].begin(), motions[i].end(), [](const auto &u) { return u.norm() > 0.; }))
          felt.push_back(i);
      FullMatrix<double> part(felt.size(), felt.size());
      part.extract_submatrix_from(resistance, felt, felt);
      return part;
    }

    template <int dim>
    SurfaceVelocity<dim> surface_velocity(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                          const Rates<dim> &rates)
    {
      const Tensor<2, dim> R = configuration.pose.rotation();
      SurfaceVelocity<dim> motion(swimmer.n_surface_nodes());
      for (unsigned int k = 0; k < motion.size(); ++k)
      {
        const int      node = swimmer.tail_node(k);
        Tensor<1, dim> X    = swimmer.surface_at_rest(k), deforming;
        if (node >= 0)
        {
          X += configuration.shape[node];
          deforming = rates.shape_rate[node];
        }
        motion[k] = rates.velocity + R * (rotational_velocity<dim>(rates.omega, X) + deforming);
      }
      return motion;
    }

    void symmetrize(FullMatrix<double> &R)
    {
      for (unsigned int i = 0; i < R.m(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          R(i, j) = R(j, i) = (R(i, j) + R(j, i)) / 2;
    }
  } // namespace

  template <int dim>
  MotionResistance<dim> compute_motion_resistance(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                                  const Configuration<dim>           &configuration,
                                                  const std::vector<NodalField<dim>> &modes)
  {
    const auto          motions = surface_velocities(swimmer, configuration, modes);
    const unsigned int  n       = motions.size();
    std::vector<double> area_rates(n, 0.);
    for (unsigned int j = 0; j < modes.size(); ++j)
      area_rates[n_rigid_in_plane + j] = swimmer.volume_rate(configuration, {{}, {}, modes[j]});
    const bool          closed = !swimmer.scene().domain->has_traction_free_wall();
    SurfaceProblem<dim> problem(fluid, closed);
    const auto          responses = problem.respond(motions, area_rates);

    MotionResistance<dim> result{FullMatrix<double>(n, n), 0.};
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        // The level of a closed domain's pressure is free: with mean zero, a source spread evenly does no work.
        result.matrix(i, j) = -responses[j].mean_pressure * area_rates[i];
        for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
          for (int c = 0; c < dim; ++c)
            result.matrix(i, j) += motions[i][k][c] * responses[j].force[fluid.surface_row(k, c)];
      }
    const FullMatrix<double> felt = felt_by_the_fluid(result.matrix, motions);
    result.asymmetry              = largest_asymmetry(felt);
    check_resistance(felt, result.asymmetry);
    symmetrize(result.matrix);
    return result;
  }

  template <int dim>
  MotionResistance<dim> compute_motion_resistance(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                                  const std::vector<NodalField<dim>> &modes,
                                                  const MPI_Comm                      communicator)
  {
    const FluidDomain<dim> fluid(swimmer.scene(), mesh_for_given_motions(swimmer, configuration, communicator),
                                 configuration.pose);
    return compute_motion_resistance(swimmer, fluid, configuration, modes);
  }

  template <int dim>
  std::vector<double> compute_flow(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                   const Configuration<dim> &configuration, const Rates<dim> &rates)
  {
    const bool          closed = !swimmer.scene().domain->has_traction_free_wall();
    SurfaceProblem<dim> problem(fluid, closed);
    return problem
        .flows({surface_velocity(swimmer, configuration, rates)},
               {swimmer.has_tail() ? swimmer.volume_rate(configuration, rates) : 0.})
        .front();
  }

  template struct MotionResistance<2>;
  template struct MotionResistance<3>;
  template MotionResistance<2> compute_motion_resistance<2>(const Swimmer<2> &, const FluidDomain<2> &,
                                                            const Configuration<2> &,
                                                            const std::vector<NodalField<2>> &);
  template MotionResistance<2> compute_motion_resistance<2>(const Swimmer<2> &, const Configuration<2> &,
                                                            const std::vector<NodalField<2>> &, MPI_Comm);
  template MotionResistance<3> compute_motion_resistance<3>(const Swimmer<3> &, const FluidDomain<3> &,
                                                            const Configuration<3> &,
                                                            const std::vector<NodalField<3>> &);
  template MotionResistance<3> compute_motion_resistance<3>(const Swimmer<3> &, const Configuration<3> &,
                                                            const std::vector<NodalField<3>> &, MPI_Comm);
  template std::vector<double> compute_flow<2>(const Swimmer<2> &, const FluidDomain<2> &, const Configuration<2> &,
                                               const Rates<2> &);
  template std::vector<double> compute_flow<3>(const Swimmer<3> &, const FluidDomain<3> &, const Configuration<3> &,
                                               const Rates<3> &);
} // namespace swimtwin
