#include <fom/resistance/motion_resistance.h>

#include <datasets/system/error.h>
#include <fom/body/mesh_around.h>
#include <fom/resistance/positive_definite.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Velocities of the surface's nodes in one motion, laboratory frame.
    template <int dim>
    using SurfaceVelocity = std::vector<Tensor<1, dim>>;

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
    std::vector<SurfaceVelocity<dim>> surface_velocities(const Swimmer<dim>                 &swimmer,
                                                         const Configuration<dim>           &configuration,
                                                         const std::vector<NodalField<dim>> &modes)
    {
      const Tensor<2, dim>              R = configuration.pose.rotation();
      const unsigned int                n = swimmer.n_surface_nodes();
      std::vector<SurfaceVelocity<dim>> motions(n_rigid<dim> + modes.size(), SurfaceVelocity<dim>(n));
      for (unsigned int k = 0; k < n; ++k)
      {
        const int      node = swimmer.tail_node(k);
        Tensor<1, dim> X    = swimmer.surface_at_rest(k);
        if (node >= 0)
          X += configuration.shape[node];
        for (int j = 0; j < dim; ++j)
          for (int c = 0; c < dim; ++c)
            motions[j][k][c] = R[c][j];
        for (int j = 0; j < n_rotations<dim>; ++j)
        {
          AngularVelocity<dim> omega;
          omega[j]            = 1.;
          motions[dim + j][k] = R * rotational_velocity<dim>(omega, X);
        }
        if (node >= 0)
          for (unsigned int j = 0; j < modes.size(); ++j)
            motions[n_rigid<dim> + j][k] = R * modes[j][node];
      }
      return motions;
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

    template <int dim>
    MotionMap<dim> held_surface(const FluidDomain<dim> &fluid, const bool closed, const MPI_Comm communicator)
    {
      MotionMap<dim> map(fluid.n_rows(), 0, 1.);
      fluid.describe(map, closed);
      for (unsigned int k = 0; k < fluid.n_surface_nodes(); ++k)
        for (int c = 0; c < dim; ++c)
          map.impose(fluid.surface_row(k, c));
      std::vector<unsigned int> owner;
      for (unsigned int row = 0; row < fluid.n_rows(); ++row)
        owner.push_back(fluid.row_owner(row));
      map.close(owner, false, communicator);
      return map;
    }

    /// The fluid's system with the body's surface held; each motion is a right-hand side.
    template <int dim>
    class SurfaceProblem
    {
    public:
      SurfaceProblem(const FluidDomain<dim> &fluid, const bool closed)
          : fluid_(fluid), map_(held_surface(fluid, closed, fluid.mesh().communicator())), condensation_(map_),
            solver_(fluid.mesh().communicator(), {.symmetric = true})
      {
        fluid_.add_cells(condensation_);
        condensation_.lay_out(solver_);
        condensation_.reset();
        fluid_.assemble(condensation_, closed ? 1. : 0.);
        solver_.set_matrix(condensation_.values());
        load_of_source_.resize(condensation_.right_hand_side().size());
        Utilities::MPI::sum(condensation_.right_hand_side(), fluid_.mesh().communicator(), load_of_source_);
      }

      struct Response
      {
        std::vector<double> force;              ///< on the fluid at all rows; right at those of the surface
        double              mean_pressure = 0.; ///< Pa; of a closed domain, where its level means nothing
      };

      /// Response to each motion. `area_rates` of the body by each motion are taken up by the fluid if the domain is
      /// closed.
      std::vector<Response> respond(const std::vector<SurfaceVelocity<dim>> &motions,
                                    const std::vector<double>               &area_rates)
      {
        std::vector<std::vector<double>> columns;
        for (unsigned int j = 0; j < motions.size(); ++j)
          columns.push_back(load(motions[j], area_rates[j]));
        if (!solver_.solve_together(columns))
          throw ComputationError("the Stokes problems of the resistance matrix could not be solved: change [numerics] "
                                 "mesh_size_m");
        std::vector<Response> responses;
        for (unsigned int j = 0; j < motions.size(); ++j)
          responses.push_back({fluid_.force_on_fluid_at_surface(values(motions[j], &columns[j])),
                               -std::inner_product(columns[j].begin(), columns[j].end(), load_of_source_.begin(), 0.)});
        return responses;
      }

      /// Values of the fluid's rows in one motion.
      std::vector<double> flow(const SurfaceVelocity<dim> &motion, const double area_rate)
      {
        std::vector<std::vector<double>> columns = {load(motion, area_rate)};
        if (!solver_.solve_together(columns))
          throw ComputationError("the flow around the body could not be solved: change [numerics] mesh_size_m");
        return values(motion, &columns.front());
      }

    private:
      /// Rows' values: those at the surface, and the others from unknowns, if there are any yet.
      std::vector<double> values(const SurfaceVelocity<dim> &motion, const std::vector<double> *unknowns) const
      {
        std::vector<double> rows = unknowns ? map_.expand(*unknowns) : std::vector<double>(map_.n_rows(), 0.);
        rows.resize(fluid_.n_rows());
        for (unsigned int k = 0; k < motion.size(); ++k)
          for (int c = 0; c < dim; ++c)
            rows[fluid_.surface_row(k, c)] = motion[k][c];
        return rows;
      }

      std::vector<double> load(const SurfaceVelocity<dim> &motion, const double area_rate)
      {
        const std::vector<double> force = fluid_.force_on_fluid_at_surface(values(motion, nullptr));
        std::vector<double>       rhs   = load_of_source_;
        for (double &value : rhs)
          value *= -area_rate;
        for (unsigned int row = 0; row < force.size(); ++row)
          if (force[row] != 0.)
            map_.add_load(row, -force[row], rhs);
        return rhs;
      }

      const FluidDomain<dim> &fluid_;
      MotionMap<dim>          map_;
      Condensation<dim>       condensation_;
      LinearSystem            solver_;
      std::vector<double>     load_of_source_; ///< of a unit source spread over the fluid; zero in an open domain
    };

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
      area_rates[n_rigid<dim> + j] = swimmer.volume_rate(configuration, {{}, {}, modes[j]});
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
    const FluidDomain<dim> fluid(swimmer.scene(), mesh_whole_around(swimmer, configuration, communicator),
                                 configuration.pose);
    return compute_motion_resistance(swimmer, fluid, configuration, modes);
  }

  template <int dim>
  std::vector<double> compute_flow(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                   const Configuration<dim> &configuration, const Rates<dim> &rates)
  {
    const bool          closed = !swimmer.scene().domain->has_traction_free_wall();
    SurfaceProblem<dim> problem(fluid, closed);
    return problem.flow(surface_velocity(swimmer, configuration, rates),
                        swimmer.has_tail() ? swimmer.volume_rate(configuration, rates) : 0.);
  }

  template struct MotionResistance<2>;
  template MotionResistance<2> compute_motion_resistance<2>(const Swimmer<2> &, const FluidDomain<2> &,
                                                            const Configuration<2> &,
                                                            const std::vector<NodalField<2>> &);
  template MotionResistance<2> compute_motion_resistance<2>(const Swimmer<2> &, const Configuration<2> &,
                                                            const std::vector<NodalField<2>> &, MPI_Comm);
  template std::vector<double> compute_flow<2>(const Swimmer<2> &, const FluidDomain<2> &, const Configuration<2> &,
                                               const Rates<2> &);
} // namespace swimtwin
