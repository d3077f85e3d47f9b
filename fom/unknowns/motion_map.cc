#include <fom/unknowns/motion_map.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  NodeNumbering<dim>::NodeNumbering(const SimplexMesh<dim> &mesh, const bool with_pressure)
      : dof_handler_(mesh.triangulation()), vector_index_(mesh.n_nodes() * dim), pressure_index_(mesh.n_vertices(), 0)
  {
    if (with_pressure)
      dof_handler_.distribute_dofs(FESystem<dim>(FE_SimplexP<dim>(2), dim, FE_SimplexP<dim>(1), 1));
    else
      dof_handler_.distribute_dofs(FESystem<dim>(FE_SimplexP<dim>(2), dim));

    const auto                          &fe = dof_handler_.get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    unsigned int                         c = 0;
    for (const auto &cell : dof_handler_.active_cell_iterators())
    {
      const auto &nodes = mesh.cells[c++];
      cell->get_dof_indices(indices);
      for (unsigned int i = 0; i < indices.size(); ++i)
      {
        const auto [component, shape] = fe.system_to_component_index(i);
        if (component < dim)
          vector_index_[nodes[shape] * dim + component] = indices[i];
        else
          pressure_index_[nodes[shape]] = indices[i];
      }
    }

    // Every rank marks what it owns; the sum is known to all.
    owner_.assign(dof_handler_.n_dofs(), 0);
    for (const auto i : dof_handler_.locally_owned_dofs())
      owner_[i] = Utilities::MPI::this_mpi_process(mesh.communicator());
    Utilities::MPI::sum(owner_, mesh.communicator(), owner_);
  }

  template <int dim>
  MotionMap<dim>::MotionMap(const unsigned int n_fluid_rows, const unsigned int n_tail_rows,
                            const double length_scale_m)
      : imposed(n_fluid_rows + n_tail_rows + n_rigid<dim>, 0.), length_scale_(length_scale_m),
        kind_(imposed.size(), Kind::free), head_row_of_row_(imposed.size(), -1), masters_(imposed.size()),
        sign_(imposed.size(), 1.), rotation_(unit_symmetric_tensor<dim>())
  {
    for (int k = 0; k < n_rigid<dim>; ++k)
    {
      kind_[head_row(k)] = Kind::head;
      head_components_.push_back(k);
    }
  }

  template <int dim>
  std::optional<unsigned int> MotionMap<dim>::head_unknown(const int component) const
  {
    if (head_is_free_)
      for (unsigned int i = 0; i < head_components_.size(); ++i)
        if (head_components_[i] == component)
          return first_head_unknown() + i;
    return std::nullopt;
  }

  template <int dim>
  void MotionMap<dim>::impose(const unsigned int row)
  {
    kind_[row] = Kind::imposed;
  }

  template <int dim>
  void MotionMap<dim>::tie_to_head(const unsigned int row, const unsigned int component, const Tensor<1, dim> &X)
  {
    kind_[row]            = Kind::on_head;
    head_row_of_row_[row] = head_rows_.size();
    head_rows_.push_back({component, X});
  }

  template <int dim>
  void MotionMap<dim>::tie_and_turn(const unsigned int row, const unsigned int without_rotation,
                                    const unsigned int component, const Tensor<1, dim> &X)
  {
    tie_to_head(row, component, X);
    tie(row, {without_rotation});
    kind_[row] = Kind::turning;
  }

  template <int dim>
  void MotionMap<dim>::tie(const unsigned int row, std::vector<unsigned int> masters)
  {
    kind_[row]    = Kind::tied;
    masters_[row] = std::move(masters);
  }

  template <int dim>
  void MotionMap<dim>::reflect(const unsigned int row, const unsigned int original, const double sign)
  {
    if (kind_[row] == Kind::imposed)
      return;
    tie(row, {original});
    sign_[row] = sign;
  }

  template <int dim>
  void MotionMap<dim>::append_terms(const unsigned int row, const double factor)
  {
    switch (kind_[row])
    {
    case Kind::free:
      terms_.push_back({unknown_[row], factor});
      break;
    case Kind::imposed:
      break;
    case Kind::head:
      if (const int k = row - head_row(0); const auto unknown = head_unknown(k))
        terms_.push_back({*unknown, k < dim ? factor : factor / length_scale_});
      break;
    case Kind::on_head: {
      const HeadRow &on_head = head_rows_[head_row_of_row_[row]];
      if (const auto unknown = head_unknown(on_head.component))
        terms_.push_back({*unknown, factor});
      append_rotation(on_head, factor);
      break;
    }
    case Kind::tied:
      for (const auto master : masters_[row])
        append_terms(master, sign_[row] * factor / masters_[row].size());
      break;
    case Kind::turning:
      append_terms(masters_[row].front(), factor);
      append_rotation(head_rows_[head_row_of_row_[row]], factor);
      break;
    }
  }

  template <int dim>
  void MotionMap<dim>::append_rotation(const HeadRow &row, const double factor)
  {
    const Tensor<1, dim> r = rotation_ * row.X / length_scale_;
    for (int k = 0; k < n_rotations<dim>; ++k)
      if (const auto unknown = head_unknown(dim + k))
      {
        AngularVelocity<dim> axis;
        axis[k] = factor;
        terms_.push_back({*unknown, rotational_velocity<dim>(axis, r)[row.component]});
      }
  }

  template <int dim>
  void MotionMap<dim>::give(const unsigned int row, const double value)
  {
    given_.resize(n_rows(), 0.);
    const bool follows = kind_[row] == Kind::tied && kind_[masters_[row].front()] == Kind::tied;
    given_[row]        = follows ? 0. : value;
  }

  template <int dim>
  double MotionMap<dim>::given_rotation(const HeadRow &row) const
  {
    AngularVelocity<dim> omega;
    for (int k = 0; k < n_rotations<dim>; ++k)
      omega[k] = given_[head_row(dim + k)];
    return rotational_velocity<dim>(omega, rotation_ * row.X)[row.component];
  }

  template <int dim>
  double MotionMap<dim>::follow_given(const unsigned int row) const
  {
    switch (kind_[row])
    {
    case Kind::free:
      return 0.;
    case Kind::imposed:
      return imposed[row];
    case Kind::head:
      return given_[row];
    case Kind::on_head: {
      const HeadRow &on_head = head_rows_[head_row_of_row_[row]];
      return given_[head_row(on_head.component)] + given_rotation(on_head);
    }
    case Kind::tied: {
      double sum = 0.;
      for (const auto master : masters_[row])
        sum += follow_given(master);
      return given_[row] + sign_[row] * sum / masters_[row].size();
    }
    case Kind::turning:
      return follow_given(masters_[row].front()) + given_rotation(head_rows_[head_row_of_row_[row]]);
    }
    return 0.;
  }

  template <int dim>
  void MotionMap<dim>::build_terms()
  {
    terms_.clear();
    first_term_.clear();
    for (unsigned int row = 0; row < n_rows(); ++row)
    {
      first_term_.push_back(terms_.size());
      append_terms(row, 1.);
    }
    first_term_.push_back(terms_.size());
    for (unsigned int row = 0; !given_.empty() && row < n_rows(); ++row)
      imposed[row] = follow_given(row);
  }

  template <int dim>
  void MotionMap<dim>::close(const std::vector<unsigned int> &owner, const bool head_is_free,
                             const MPI_Comm communicator)
  {
    head_is_free_             = head_is_free;
    const unsigned int n_rank = Utilities::MPI::n_mpi_processes(communicator),
                       me     = Utilities::MPI::this_mpi_process(communicator);

    std::vector<unsigned int> first_of_rank(n_rank + 1, 0);
    for (unsigned int row = 0; row < n_rows(); ++row)
      if (kind_[row] == Kind::free)
        ++first_of_rank[owner[row] + 1];
    first_of_rank[n_rank] += n_head_unknowns();
    for (unsigned int rank = 0; rank < n_rank; ++rank)
      first_of_rank[rank + 1] += first_of_rank[rank];
    n_unknowns_  = first_of_rank[n_rank];
    first_owned_ = first_of_rank[me];
    last_owned_  = first_of_rank[me + 1];

    std::vector<unsigned int> next(first_of_rank.begin(), first_of_rank.end() - 1);
    unknown_.assign(n_rows(), 0);
    for (unsigned int row = 0; row < n_rows(); ++row)
      if (kind_[row] == Kind::free)
        unknown_[row] = next[owner[row]]++;
    build_terms();
  }

  template <int dim>
  void MotionMap<dim>::set_rotation(const Tensor<2, dim> &rotation)
  {
    rotation_ = rotation;
    build_terms();
  }

  template <int dim>
  std::vector<double> MotionMap<dim>::expand(const std::vector<double> &unknowns) const
  {
    std::vector<double> values(n_rows());
    for (unsigned int row = 0; row < n_rows(); ++row)
      values[row] = value(row, unknowns);
    return values;
  }

  template <int dim>
  void MotionMap<dim>::add_load(const unsigned int row, const double load, std::vector<double> &right_hand_side) const
  {
    for (const Term *term = begin(row); term != end(row); ++term)
      right_hand_side[term->unknown] += term->coefficient * load;
  }

  template class NodeNumbering<2>;
  template class NodeNumbering<3>;
  template class MotionMap<2>;
  template class MotionMap<3>;
} // namespace swimtwin
