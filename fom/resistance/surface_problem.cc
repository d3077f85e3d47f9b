#include <fom/resistance/surface_problem.h>

#include <datasets/system/error.h>

#include <numeric>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  std::vector<SurfaceVelocity<dim>> surface_velocities(const Swimmer<dim>                 &swimmer,
                                                       const Configuration<dim>           &configuration,
                                                       const std::vector<NodalField<dim>> &modes)
  {
    const Tensor<2, dim>              R = configuration.pose.rotation();
    const unsigned int                n = swimmer.n_surface_nodes();
    std::vector<SurfaceVelocity<dim>> motions(n_rigid_in_plane + modes.size(), SurfaceVelocity<dim>(n));
    for (unsigned int k = 0; k < n; ++k)
    {
      const int      node = swimmer.tail_node(k);
      Tensor<1, dim> X    = swimmer.surface_at_rest(k);
      if (node >= 0)
        X += configuration.shape[node];
      for (int j = 0; j < n_rigid_in_plane; ++j)
        motions[j][k] = R * unit_motion_in_plane<dim>(j, X);
      if (node >= 0)
        for (unsigned int j = 0; j < modes.size(); ++j)
          motions[n_rigid_in_plane + j][k] = R * modes[j][node];
    }
    return motions;
  }

  namespace
  {
    template <int dim>
    MotionMap<dim> held_surface(const FluidDomain<dim> &fluid, const bool closed, const MPI_Comm communicator)
    {
      MotionMap<dim> map(fluid.n_rows(), 0, 1.);
      fluid.describe(map, closed);
      for (unsigned int k = 0; k < fluid.n_surface_nodes(); ++k)
        for (int c = 0; c < dim; ++c)
          map.impose(fluid.surface_row(k, c));
      fluid.describe_mirror(map);
      std::vector<unsigned int> owner;
      for (unsigned int row = 0; row < fluid.n_rows(); ++row)
        owner.push_back(fluid.row_owner(row));
      map.close(owner, false, communicator);
      return map;
    }
  } // namespace

  template <int dim>
  SurfaceProblem<dim>::SurfaceProblem(const FluidDomain<dim> &fluid, const bool closed)
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

  template <int dim>
  std::vector<std::vector<double>> SurfaceProblem<dim>::solved(const std::vector<SurfaceVelocity<dim>> &motions,
                                                               const std::vector<double>               &area_rates)
  {
    std::vector<std::vector<double>> columns;
    for (unsigned int j = 0; j < motions.size(); ++j)
      columns.push_back(load(motions[j], area_rates[j]));
    if (!solver_.solve_together(columns))
      throw ComputationError("the Stokes flows around the body could not be solved: change [numerics] mesh_size_m");
    return columns;
  }

  template <int dim>
  std::vector<typename SurfaceProblem<dim>::Response>
  SurfaceProblem<dim>::respond(const std::vector<SurfaceVelocity<dim>> &motions, const std::vector<double> &area_rates)
  {
    const auto            columns = solved(motions, area_rates);
    std::vector<Response> responses;
    for (unsigned int j = 0; j < motions.size(); ++j)
      responses.push_back({fluid_.force_on_fluid_at_surface(values(motions[j], &columns[j])),
                           -std::inner_product(columns[j].begin(), columns[j].end(), load_of_source_.begin(), 0.)});
    return responses;
  }

  template <int dim>
  std::vector<std::vector<double>> SurfaceProblem<dim>::flows(const std::vector<SurfaceVelocity<dim>> &motions,
                                                              const std::vector<double>               &area_rates)
  {
    auto columns = solved(motions, area_rates);
    for (unsigned int j = 0; j < motions.size(); ++j)
      columns[j] = values(motions[j], &columns[j]);
    return columns;
  }

  template <int dim>
  std::vector<std::vector<double>> SurfaceProblem<dim>::flows_under(const std::vector<std::vector<double>> &loads)
  {
    std::vector<std::vector<double>> columns;
    for (const auto &load_of_rows : loads)
    {
      columns.emplace_back(load_of_source_.size(), 0.);
      for (unsigned int row = 0; row < fluid_.n_rows(); ++row)
        map_.add_load(row, load_of_rows[row], columns.back());
    }
    if (!solver_.solve_together(columns))
      throw ComputationError("the Stokes flows around the body could not be solved: change [numerics] mesh_size_m");
    const SurfaceVelocity<dim> at_rest(fluid_.n_surface_nodes());
    for (auto &column : columns)
      column = values(at_rest, &column);
    return columns;
  }

  template <int dim>
  std::vector<double> SurfaceProblem<dim>::values(const SurfaceVelocity<dim> &motion,
                                                  const std::vector<double>  *unknowns) const
  {
    std::vector<double> rows = unknowns ? map_.expand(*unknowns) : std::vector<double>(map_.n_rows(), 0.);
    rows.resize(fluid_.n_rows());
    for (unsigned int k = 0; k < motion.size(); ++k)
      for (int c = 0; c < dim; ++c)
        rows[fluid_.surface_row(k, c)] = motion[k][c];
    return rows;
  }

  template <int dim>
  std::vector<double> SurfaceProblem<dim>::load(const SurfaceVelocity<dim> &motion, const double area_rate) const
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

  template std::vector<SurfaceVelocity<2>> surface_velocities<2>(const Swimmer<2> &, const Configuration<2> &,
                                                                 const std::vector<NodalField<2>> &);
  template std::vector<SurfaceVelocity<3>> surface_velocities<3>(const Swimmer<3> &, const Configuration<3> &,
                                                                 const std::vector<NodalField<3>> &);
  template class SurfaceProblem<2>;
  template class SurfaceProblem<3>;
} // namespace swimtwin
