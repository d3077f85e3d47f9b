#include <rom/training/load_response.h>

#include <fom/elastic/nodal_vector.h>
#include <rom/swimmer/dense_algebra.h>

namespace swimtwin
{
  namespace
  {
    /// F^T K F over Young's modulus, K the tail's stiffness at rest.
    template <int dim>
    Eigen::MatrixXd stiffness_of(const Swimmer<dim> &swimmer, const Eigen::MatrixXd &fields)
    {
      constexpr int         n    = dim * n_cell_nodes<dim>;
      const auto           &mesh = swimmer.tail().mesh;
      const NodalField<dim> rest = nodal_field<dim>(Eigen::VectorXd::Zero(fields.rows()));

      typename ElasticTail<dim>::CellForce   force;
      typename ElasticTail<dim>::CellTangent tangent;
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(fields.cols(), fields.cols()), in_cell(n, fields.cols()), K(n, n);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        swimmer.elasticity().cell_force_and_tangent(c, rest, force, tangent);
        for (int i = 0; i < n; ++i)
        {
          in_cell.row(i) = fields.row(dim * mesh.cells[c][i / dim] + i % dim);
          for (int j = 0; j < n; ++j)
            K(i, j) = tangent[i][j];
        }
        sum += in_cell.transpose() * K * in_cell;
      }
      return sum / swimmer.scene().tail->young_modulus_Pa;
    }
  } // namespace

  template <int dim>
  LoadResponse fit_load_response(const Swimmer<dim> &swimmer, const TailSpace &space, const BentTail &least_energy,
                                 const Eigen::MatrixXd &displacements, const Eigen::MatrixXd &q)
  {
    constexpr double told = 2e-3; // of the largest coordinate: less of another one does not tell its response
    Eigen::MatrixXd  left = displacements;
    for (Eigen::Index k = 0; k < left.cols(); ++k)
      left.col(k) -= least_energy.modes * least_energy.polynomials.value(q.col(k));
    const Eigen::MatrixXd odd      = (left - space.mirrored(left)) / 2.;
    const double          smallest = told * q.cwiseAbs().maxCoeff();
    Eigen::MatrixXd       moments  = q * q.transpose() / static_cast<double>(q.cols());
    moments.diagonal().array() += smallest * smallest;
    const Eigen::MatrixXd with_odd = q * odd.transpose() / static_cast<double>(q.cols());
    const Eigen::MatrixXd fields   = solve_symmetric(moments, with_odd).transpose();
    return {fields, stiffness_of(swimmer, fields)};
  }

  template LoadResponse fit_load_response<2>(const Swimmer<2> &, const TailSpace &, const BentTail &,
                                             const Eigen::MatrixXd &, const Eigen::MatrixXd &);
  template LoadResponse fit_load_response<3>(const Swimmer<3> &, const TailSpace &, const BentTail &,
                                             const Eigen::MatrixXd &, const Eigen::MatrixXd &);
} // namespace swimtwin
