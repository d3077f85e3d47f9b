#include <datasets/surface/simplex_edges.h>
#include <rom/sweep/tail_mass_matrix.h>

#include <array>
#include <cmath>
#include <vector>

namespace swimtwin
{
  namespace
  {
    /// Barycentric coordinates, and a share of the reference cell's volume times its own.
    struct QuadraturePoint
    {
      Eigen::VectorXd place;
      double          weight = 0.;
    };

    /// Degree 6 (Dunavant 1985, 12 points): exact for products of quadratic shape functions on straight triangles and,
    /// with the quadratic Jacobian determinant, on curved ones.
    std::vector<QuadraturePoint> triangle_quadrature()
    {
      std::vector<QuadraturePoint> points;
      const auto                   add = [&](const double a, const double b, const double weight) {
        const double c = 1. - a - b;
        for (const auto &[xi, eta] : {std::pair{a, b}, {b, c}, {c, a}})
          points.push_back({Eigen::Vector3d(1. - xi - eta, xi, eta), 0.5 * weight});
      };
      add(0.249286745170910, 0.249286745170910, 0.116786275726379);
      add(0.063089014491502, 0.063089014491502, 0.050844906370207);
      add(0.310352451033785, 0.053145049844816, 0.082851075618374);
      add(0.053145049844816, 0.310352451033785, 0.082851075618374);
      return points;
    }

    /// Gauss's five points along each edge of a cube that is pulled to a corner: degree 7 on a tetrahedron.
    std::vector<QuadraturePoint> tetrahedron_quadrature()
    {
      const double far       = std::sqrt(5. + 2. * std::sqrt(10. / 7.)) / 3.,
                   near      = std::sqrt(5. - 2. * std::sqrt(10. / 7.)) / 3.;
      const double     heavy = (322. + 13. * std::sqrt(70.)) / 900., light = (322. - 13. * std::sqrt(70.)) / 900.;
      const std::array gauss{std::pair{-far, light}, std::pair{-near, heavy}, std::pair{0., 128. / 225.},
                             std::pair{near, heavy}, std::pair{far, light}};
      std::vector<QuadraturePoint> points;
      for (const auto &[a, weight_a] : gauss)
        for (const auto &[b, weight_b] : gauss)
          for (const auto &[c, weight_c] : gauss)
          {
            const double u = (1. + a) / 2., v = (1. + b) / 2., w = (1. + c) / 2.;
            const double x = u, y = (1. - u) * v, z = (1. - u) * (1. - v) * w;
            points.push_back({Eigen::Vector4d(1. - x - y - z, x, y, z),
                              weight_a * weight_b * weight_c / 8. * (1. - u) * (1. - u) * (1. - v)});
          }
      return points;
    }

    /// Quadratic shape functions: of the vertices, then of the edges' middles.
    Eigen::VectorXd shape_functions(const Eigen::VectorXd &L, const Eigen::Index n)
    {
      Eigen::VectorXd N(n);
      for (Eigen::Index i = 0; i < n; ++i)
        if (i < L.size())
          N[i] = L[i] * (2. * L[i] - 1.);
        else
        {
          const auto &[a, b] = simplex_edges[static_cast<std::size_t>(i - L.size())];
          N[i]               = 4. * L[a] * L[b];
        }
      return N;
    }

    /// Their derivatives by the last `dim` barycentric coordinates, dim x n.
    Eigen::MatrixXd shape_gradients(const Eigen::VectorXd &L, const Eigen::Index n)
    {
      const Eigen::Index m        = L.size();
      Eigen::MatrixXd    by_place = Eigen::MatrixXd::Zero(m, n);
      for (Eigen::Index i = 0; i < n; ++i)
        if (i < m)
          by_place(i, i) = 4. * L[i] - 1.;
        else
        {
          const auto &[a, b] = simplex_edges[static_cast<std::size_t>(i - m)];
          by_place(a, i)     = 4. * L[b];
          by_place(b, i)     = 4. * L[a];
        }
      return by_place.bottomRows(m - 1).rowwise() - by_place.row(0);
    }
  } // namespace

  Eigen::SparseMatrix<double> tail_mass_matrix(const Eigen::MatrixXd &nodes_m, const Eigen::MatrixXi &cells)
  {
    const Eigen::Index           dim = nodes_m.cols(), n = cells.cols();
    std::vector<Eigen::MatrixXd> products, gradients;
    for (const auto &[place, weight] : dim == 3 ? tetrahedron_quadrature() : triangle_quadrature())
    {
      const Eigen::VectorXd N = shape_functions(place, n);
      products.push_back(weight * N * N.transpose());
      gradients.push_back(shape_gradients(place, n));
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index c = 0; c < cells.rows(); ++c)
    {
      const Eigen::MatrixXd x    = nodes_m(cells.row(c), Eigen::all);
      Eigen::MatrixXd       mass = Eigen::MatrixXd::Zero(n, n);
      for (std::size_t q = 0; q < products.size(); ++q)
        mass += std::abs((gradients[q] * x).determinant()) * products[q];
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          for (Eigen::Index component = 0; component < dim; ++component)
            entries.emplace_back(dim * cells(c, i) + component, dim * cells(c, j) + component, mass(i, j));
    }
    Eigen::SparseMatrix<double> matrix(nodes_m.size(), nodes_m.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
} // namespace swimtwin
