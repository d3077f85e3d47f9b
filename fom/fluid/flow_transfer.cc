#include <fom/fluid/flow_transfer.h>

#include <datasets/system/error.h>
#include <fom/geometry/cell_search.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// int u . v - s p div v - s q div u with the load int u* . v.
    template <int dim>
    void projection_system(const IsoparametricCell<dim> &cell, const double scale,
                           const std::array<Tensor<1, dim>, n_cell_nodes<dim>> &flow, FluidCellMatrix<dim> &matrix,
                           std::array<double, n_fluid_cell_dofs<dim>> &load)
    {
      stokes_cell_matrix<dim>(cell, 0., scale, matrix);
      load.fill(0.);
      CellFlow<dim> known;
      known.known = flow;
      add_unsteady_term<dim>(cell, {.density_kg_m3 = 1., .rate_1_s = 1.}, known, matrix, load);
    }

    template <int dim>
    double mean_size(const SimplexMesh<dim> &mesh, const std::vector<Point<dim>> &positions)
    {
      double sum = 0.;
      for (const auto &[a, b] : mesh.edges())
        sum += positions[a].distance(positions[b]);
      return sum / mesh.edges().size();
    }
  } // namespace

  template <int dim>
  void remove_divergence(const FluidDomain<dim> &fluid, FluidMotion<dim> &motion)
  {
    const auto       &mesh      = fluid.mesh();
    const auto       &numbering = fluid.numbering();
    MotionMap<dim>    map(numbering.size(), 0, 1.);
    Condensation<dim> condensation(map);
    LinearSystem      system(mesh.communicator(), {.tolerance = 1e-12, .symmetric = true});
    fluid.describe(map, !fluid.has_free_boundary());
    for (unsigned int k = 0; k < fluid.n_surface_nodes(); ++k)
      for (int c = 0; c < dim; ++c)
        map.impose(fluid.surface_row(k, c));
    std::vector<unsigned int> owner;
    for (unsigned int row = 0; row < numbering.size(); ++row)
      owner.push_back(numbering.owner(row));
    map.close(owner, false, mesh.communicator());
    for (unsigned int i = 0; i < mesh.n_nodes(); ++i)
      for (int c = 0; c < dim; ++c)
        if (const auto row = numbering.vector_index(i, c); map.begin(row) == map.end(row))
          map.imposed[row] = motion.velocity[i][c];

    std::vector<unsigned int> owned;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.is_owned(c))
      {
        owned.push_back(c);
        condensation.add_cell(fluid.cell_rows(c));
      }
    condensation.lay_out(system);
    condensation.reset();
    IsoparametricCell<dim>                     cell;
    FluidCellMatrix<dim>                       K;
    std::array<double, n_fluid_cell_dofs<dim>> load;
    const double                               scale = mean_size<dim>(mesh, motion.positions);
    for (unsigned int k = 0; k < owned.size(); ++k)
    {
      const auto                                   &nodes = mesh.cells[owned[k]];
      std::array<Tensor<1, dim>, n_cell_nodes<dim>> flow;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        flow[a] = motion.velocity[nodes[a]];
      cell.reinit(cell_positions<dim>(nodes, motion.positions));
      projection_system<dim>(cell, scale, flow, K, load);
      condensation.add(k, K, load);
    }
    system.set_matrix(condensation.values());
    system.set_right_hand_side(condensation.right_hand_side());
    std::vector<double> unknowns(map.n_unknowns(), 0.);
    if (!system.solve(unknowns))
      throw ComputationError("the flow could not be brought onto a new mesh: refine [numerics] mesh_size_m");
    const std::vector<double> values = map.expand(unknowns);
    for (unsigned int i = 0; i < mesh.n_nodes(); ++i)
      for (int c = 0; c < dim; ++c)
        motion.velocity[i][c] = values[numbering.vector_index(i, c)];
  }

  template <int dim>
  FluidPast<dim> transfer_past(const FluidDomain<dim> &from, const FluidDomain<dim> &to)
  {
    const auto &[now, before]  = from.past();
    const auto           &mesh = to.mesh();
    const CellSearch<dim> search(from.mesh(), now.positions);

    std::vector<Tensor<1, dim>> way;
    for (unsigned int i = 0; i < now.positions.size(); ++i)
      way.push_back(now.positions[i] - before.positions[i]);

    FluidPast<dim> past;
    past.now        = {to.positions(), std::vector<Tensor<1, dim>>(mesh.n_nodes())};
    past.before     = past.now;
    const auto take = [&](const unsigned int node, const Tensor<1, dim> &u, const Tensor<1, dim> &u_before,
                          const Tensor<1, dim> &came) {
      past.now.velocity[node]     = u;
      past.before.velocity[node]  = u_before;
      past.before.positions[node] = past.now.positions[node] - came;
    };
    for (unsigned int i = 0; i < mesh.n_nodes(); ++i)
    {
      const auto place = search.find(past.now.positions[i]);
      if (!place)
        throw ComputationError("a node of the new mesh lies outside the old one: refine [numerics] mesh_size_far_m");
      const auto &nodes = from.mesh().cells[place->cell];
      take(i, place->interpolate(nodes, now.velocity), place->interpolate(nodes, before.velocity),
           place->interpolate(nodes, way));
    }
    for (unsigned int k = 0; k < to.n_surface_nodes(); ++k)
    {
      const unsigned int old_node = from.fluid_mesh().surface_nodes[k], node = to.fluid_mesh().surface_nodes[k];
      take(node, now.velocity[old_node], before.velocity[old_node], way[old_node]);
    }
    remove_divergence(to, past.now);
    remove_divergence(to, past.before);
    return past;
  }

  template void         remove_divergence<2>(const FluidDomain<2> &, FluidMotion<2> &);
  template void         remove_divergence<3>(const FluidDomain<3> &, FluidMotion<3> &);
  template FluidPast<2> transfer_past<2>(const FluidDomain<2> &, const FluidDomain<2> &);
  template FluidPast<3> transfer_past<3>(const FluidDomain<3> &, const FluidDomain<3> &);
} // namespace swimtwin
