#include <fom/elastic/elastic_tail.h>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  ElasticTail<dim>::ElasticTail(const SimplexMesh<dim> &mesh, std::unique_ptr<HyperelasticLaw<dim>> law)
      : mesh_(mesh), law_(std::move(law)), volume_of_node_(mesh.n_nodes(), 0.),
        axial_gradient_of_node_(mesh.n_nodes(), 0.)
  {
    IsoparametricCell<dim> map;
    for (const auto &nodes : mesh.cells)
    {
      map.reinit(cell_positions<dim>(nodes, mesh.nodes));
      auto &points = points_.emplace_back(map.n_points());
      auto &mass   = cell_mass_.emplace_back();
      for (unsigned int q = 0; q < map.n_points(); ++q)
      {
        points[q].weight = map.weight(q);
        volume_ += map.weight(q);
        for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          points[q].gradient[a] = map.gradient(q, a);
          points[q].value[a]    = map.value(q, a);
          volume_of_node_[nodes[a]] += map.weight(q) * map.value(q, a);
          axial_gradient_of_node_[nodes[a]] += map.weight(q) * map.gradient(q, a)[0];
          for (unsigned int b = 0; b < nodes.size(); ++b)
            mass[a][b] += map.weight(q) * map.value(q, a) * map.value(q, b);
        }
      }
    }
  }

  template <int dim>
  Tensor<2, dim> ElasticTail<dim>::deformation_gradient(const Point &point, const CellNodes<dim> &nodes,
                                                        const NodalField<dim> &displacement) const
  {
    Tensor<2, dim> F;
    for (int i = 0; i < dim; ++i)
      F[i][i] = 1.;
    for (unsigned int a = 0; a < nodes.size(); ++a)
      F += outer_product(displacement[nodes[a]], point.gradient[a]);
    return F;
  }

  template <int dim>
  double ElasticTail<dim>::energy(const NodalField<dim> &displacement) const
  {
    double energy = 0.;
    for (unsigned int c = 0; c < mesh_.n_cells(); ++c)
      for (const auto &point : points_[c])
        energy += point.weight * law_->energy(deformation_gradient(point, mesh_.cells[c], displacement));
    return energy;
  }

  template <int dim>
  void ElasticTail<dim>::cell_force(const unsigned int cell, const NodalField<dim> &displacement,
                                    CellForce &force) const
  {
    force.fill(0.);
    for (const auto &point : points_[cell])
    {
      const Tensor<2, dim> stress =
          point.weight * law_->stress(deformation_gradient(point, mesh_.cells[cell], displacement));
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        const Tensor<1, dim> f = stress * point.gradient[a];
        for (int i = 0; i < dim; ++i)
          force[a * dim + i] += f[i];
      }
    }
  }

  template <int dim>
  void ElasticTail<dim>::cell_force_and_tangent(const unsigned int cell, const NodalField<dim> &displacement,
                                                CellForce &force, CellTangent &tangent) const
  {
    force.fill(0.);
    for (auto &row : tangent)
      row.fill(0.);
    for (const auto &point : points_[cell])
    {
      const auto response = law_->respond(deformation_gradient(point, mesh_.cells[cell], displacement));
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        const Tensor<1, dim> f = point.weight * (response.stress * point.gradient[a]);
        Tensor<3, dim>       half; // dP_ij/dF_kl g_j
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            for (int k = 0; k < dim; ++k)
              for (int l = 0; l < dim; ++l)
                half[i][k][l] += point.weight * response.tangent[i][j][k][l] * point.gradient[a][j];
        for (int i = 0; i < dim; ++i)
        {
          force[a * dim + i] += f[i];
          for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
            for (int k = 0; k < dim; ++k)
              tangent[a * dim + i][b * dim + k] += half[i][k] * point.gradient[b];
        }
      }
    }
  }

  template <int dim>
  double ElasticTail<dim>::norm_square(const NodalField<dim> &field) const
  {
    double sum = 0.;
    for (unsigned int c = 0; c < mesh_.n_cells(); ++c)
      for (const auto &point : points_[c])
      {
        Tensor<1, dim> value;
        for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          value += point.value[a] * field[mesh_.cells[c][a]];
        sum += point.weight * value.norm_square();
      }
    return sum;
  }

  template <int dim>
  bool ElasticTail<dim>::is_inverted(const NodalField<dim> &displacement) const
  {
    for (unsigned int c = 0; c < mesh_.n_cells(); ++c)
      for (const auto &point : points_[c])
        if (!(determinant(deformation_gradient(point, mesh_.cells[c], displacement)) > 0.))
          return true;
    return false;
  }

  template class ElasticTail<2>;
  template class ElasticTail<3>;
} // namespace swimtwin
