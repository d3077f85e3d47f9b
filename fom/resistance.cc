#include <fom/resistance.h>

#include <datasets/error.h>
#include <fom/fluid_domain.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Where every surface node is in the head frame, the shape included.
    template <int dim>
    std::vector<Tensor<1, dim>> frozen_surface(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration)
    {
      std::vector<Tensor<1, dim>> X;
      for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
      {
        const int node = swimmer.tail_node(k);
        X.push_back(swimmer.surface_at_rest(k) + (node < 0 ? Tensor<1, dim>() : configuration.shape[node]));
      }
      return X;
    }

    template <int dim>
    double largest_asymmetry(const FullMatrix<double> &R)
    {
      double largest = 0.;
      for (int i = 0; i < n_rigid<dim>; ++i)
        for (int j = 0; j < i; ++j)
          largest = std::max(largest, std::abs(R(i, j) - R(j, i)) / std::sqrt(R(i, i) * R(j, j)));
      return largest;
    }
  } // namespace

  template <int dim>
  ResistanceResult<dim> compute_resistance(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                           const MPI_Comm communicator)
  {
    const Scene     &scene = swimmer.scene();
    const auto       pose  = configuration.pose;
    FluidDomain<dim> fluid(scene,
                           make_fluid_mesh(*scene.domain, swimmer.surface(configuration), swimmer.surface_mesh_size(),
                                           pose, swimmer.pose_at_rest(), scene.numerics, communicator),
                           pose);

    MotionMap<dim> map(fluid.n_rows(), 0, scene.body_length_m());
    fluid.describe(map, !has_traction_free_wall(*scene.domain));
    const auto X = frozen_surface(swimmer, configuration);
    for (unsigned int k = 0; k < X.size(); ++k)
      for (int c = 0; c < dim; ++c)
        map.tie_to_head(fluid.surface_row(k, c), c, X[k]);
    std::vector<unsigned int> owner;
    for (unsigned int row = 0; row < fluid.n_rows(); ++row)
      owner.push_back(fluid.row_owner(row));
    map.close(owner, true, communicator);
    map.set_rotation(pose.rotation());

    Condensation<dim>   condensation(map);
    LinearSolverOptions options;
    options.tolerance = 1e-13;
    LinearSystem system(communicator, options);
    fluid.add_cells(condensation);
    condensation.lay_out(system);
    condensation.reset();
    fluid.assemble(condensation);
    system.set_matrix(condensation.values());

    // Unit loads on the head's (scaled) unknowns give the columns of the scaled mobility.
    constexpr int      n = n_rigid<dim>;
    FullMatrix<double> mobility(n, n);
    for (int j = 0; j < n; ++j)
    {
      std::vector<double> load(map.n_unknowns(), 0.), motion(map.n_unknowns(), 0.);
      if (map.last_owned() == map.n_unknowns())
        load[map.first_head_unknown() + j] = 1.;
      system.set_right_hand_side(load);
      if (!system.solve(motion))
        throw ComputationError(
            "the Stokes problem of the resistance matrix could not be solved: change [numerics] mesh_size_m");
      for (int i = 0; i < n; ++i)
        mobility(i, j) = motion[map.first_head_unknown() + i];
    }

    ResistanceResult<dim> result{FullMatrix<double>(n, n), 0., map.n_unknowns(), fluid.mesh().n_cells()};
    result.matrix.invert(mobility);
    const auto unit = [&](const int i) { return i < dim ? 1. : map.length_scale(); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        result.matrix(i, j) *= unit(i) * unit(j);
    result.asymmetry = largest_asymmetry<dim>(result.matrix);
    return result;
  }

  template struct ResistanceResult<2>;
  template ResistanceResult<2> compute_resistance<2>(const Swimmer<2> &, const Configuration<2> &, MPI_Comm);
} // namespace swimtwin
