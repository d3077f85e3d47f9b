#include <rom/training/strain_grams.h>

#include <fom/geometry/isoparametric_cell.h>

namespace swimtwin
{
  namespace
  {
    using dealii::Tensor;

    /// Gradients of all modes at one quadrature point.
    std::vector<Tensor<2, 2>> mode_gradients(const IsoparametricCell<2> &map, const unsigned int q,
                                             const CellNodes<2> &nodes, const Eigen::MatrixXd &modes)
    {
      std::vector<Tensor<2, 2>> gradients(modes.cols());
      for (Eigen::Index k = 0; k < modes.cols(); ++k)
        for (unsigned int a = 0; a < nodes.size(); ++a)
          gradients[k] += dealii::outer_product(Tensor<1, 2>({modes(2 * nodes[a], k), modes(2 * nodes[a] + 1, k)}),
                                                map.gradient(q, a));
      return gradients;
    }

    /// Green-Lagrange strain E = sum_m e_m m(q), symmetric: one row (E_11, E_22, E_12) per monomial.
    Eigen::MatrixX3d strains(const std::vector<Tensor<2, 2>> &gradients)
    {
      const int        r = static_cast<int>(gradients.size());
      Eigen::MatrixX3d e(r + r * (r + 1) / 2, 3);
      const auto       set = [&](const int row, const Tensor<2, 2> &t) {
        e.row(row) << t[0][0], t[1][1], (t[0][1] + t[1][0]) / 2.;
      };
      for (int i = 0; i < r; ++i)
      {
        set(i, gradients[i]);
        for (int j = 0; j <= i; ++j)
          set(strain_monomial(r, i, j), (i == j ? .5 : 1.) * (transpose(gradients[i]) * gradients[j]));
      }
      return e;
    }
  } // namespace

  ReducedElasticity compute_strain_grams(const Swimmer<2> &swimmer, const Eigen::MatrixXd &modes)
  {
    const auto          &mesh = swimmer.tail().mesh;
    const Eigen::Index   n    = modes.cols() + modes.cols() * (modes.cols() + 1) / 2;
    ReducedElasticity    elasticity{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n),
                                 swimmer.scene().tail->poisson_ratio};
    IsoparametricCell<2> map;
    for (const auto &nodes : mesh.cells)
    {
      map.reinit(cell_positions<2>(nodes, mesh.nodes));
      for (unsigned int q = 0; q < map.n_points(); ++q)
      {
        const Eigen::MatrixX3d e     = strains(mode_gradients(map, q, nodes, modes));
        const Eigen::VectorXd  trace = e.col(0) + e.col(1);
        elasticity.gram_lambda.noalias() += .5 * map.weight(q) * trace * trace.transpose();
        elasticity.gram_mu.noalias() +=
            map.weight(q) * (e.leftCols<2>() * e.leftCols<2>().transpose() + 2. * e.col(2) * e.col(2).transpose());
      }
    }
    return elasticity;
  }
} // namespace swimtwin
