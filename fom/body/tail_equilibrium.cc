#include <fom/body/tail_equilibrium.h>

#include <fom/body/tail_rows.h>

#include <cmath>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  TailEquilibrium<dim>::TailEquilibrium(const Swimmer<dim> &swimmer, const LinearSolverOptions &options,
                                        const MPI_Comm communicator)
      : swimmer_(swimmer), numbering_(swimmer.tail().mesh, false), map_(0, numbering_.size(), 1.), condensation_(map_),
        solver_(communicator, options)
  {
    const auto &mesh = swimmer_.tail().mesh;
    const auto  row  = [&](const unsigned int node, const unsigned int c) { return numbering_.vector_index(node, c); };
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      for (int c = 0; swimmer_.is_clamped(a) && c < dim; ++c)
        map_.impose(row(a, c));
    tie_linear_tail(map_, swimmer_, row);
    std::vector<unsigned int> owner(numbering_.size());
    for (unsigned int i = 0; i < owner.size(); ++i)
      owner[i] = numbering_.owner(i);
    map_.close(owner, false, communicator);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.is_owned(c))
      {
        owned_cells_.push_back(c);
        std::vector<unsigned int> rows;
        for (const auto node : mesh.cells[c])
          for (int i = 0; i < dim; ++i)
            rows.push_back(row(node, i));
        condensation_.add_cell(rows);
      }
    condensation_.lay_out(solver_);
  }

  template <int dim>
  void TailEquilibrium<dim>::assemble(const NodalField<dim> &loads, const NodalField<dim> &shape)
  {
    typename ElasticTail<dim>::CellForce   force;
    typename ElasticTail<dim>::CellTangent tangent;
    condensation_.reset();
    for (unsigned int k = 0; k < owned_cells_.size(); ++k)
    {
      swimmer_.elasticity().cell_force_and_tangent(owned_cells_[k], shape, force, tangent);
      for (auto &f : force)
        f = -f;
      condensation_.add(k, tangent, force);
    }
    const unsigned int rank = Utilities::MPI::this_mpi_process(swimmer_.tail().mesh.communicator());
    for (unsigned int a = 0; a < loads.size(); ++a)
      for (int c = 0; c < dim; ++c)
        if (const auto row = numbering_.vector_index(a, c); numbering_.owner(row) == rank)
          map_.add_load(row, loads[a][c], condensation_.right_hand_side());
    solver_.set_matrix(condensation_.values());
    solver_.set_right_hand_side(condensation_.right_hand_side());
  }

  template <int dim>
  NodalField<dim> TailEquilibrium<dim>::nodal(const std::vector<double> &unknowns) const
  {
    const std::vector<double> rows = map_.expand(unknowns);
    NodalField<dim>           field(swimmer_.tail().mesh.n_nodes());
    for (unsigned int a = 0; a < field.size(); ++a)
      for (int c = 0; c < dim; ++c)
        field[a][c] = rows[numbering_.vector_index(a, c)];
    return field;
  }

  template <int dim>
  bool TailEquilibrium<dim>::solve(const NodalField<dim> &loads, const double tolerance_m, NodalField<dim> &shape)
  {
    constexpr int max_iterations = 25;
    for (int iteration = 1; iteration <= max_iterations; ++iteration)
    {
      assemble(loads, shape);
      std::vector<double> update(map_.n_unknowns(), 0.);
      if (!solver_.solve(update))
        return false;
      const NodalField<dim> change = nodal(update);
      for (unsigned int a = 0; a < shape.size(); ++a)
        shape[a] += change[a];
      if (swimmer_.elasticity().is_inverted(shape))
        return false;
      if (std::sqrt(swimmer_.elasticity().norm_square(change) / swimmer_.elasticity().volume()) <= tolerance_m)
        return true;
    }
    return false;
  }

  template class TailEquilibrium<2>;
  template class TailEquilibrium<3>;
} // namespace swimtwin
