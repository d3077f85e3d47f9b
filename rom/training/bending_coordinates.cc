#include <rom/training/bending_coordinates.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    constexpr int n_axial_polynomials = 12;
  } // namespace

  template <int dim>
  BendingCoordinates::BendingCoordinates(const Swimmer<dim> &swimmer) : dimension_(dim)
  {
    const auto            &mesh = swimmer.tail().mesh;
    IsoparametricCell<dim> map;
    n_points_of_cell_ = map.n_points();
    double volume     = 0.;
    for (const auto &nodes : mesh.cells)
    {
      nodes_.emplace_back(nodes.begin(), nodes.end());
      const auto x = cell_positions<dim>(nodes, mesh.nodes);
      map.reinit(x);
      for (unsigned int q = 0; q < map.n_points(); ++q)
      {
        Point point{CellVector(2 * nodes.size()), CellVector(2 * nodes.size()), map.position(q, x)[0], map.weight(q)};
        for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const auto &g                 = map.gradient(q, a);
          point.trace.segment<2>(2 * a) = Eigen::Vector2d(g[0], g[1]);
          point.spin.segment<2>(2 * a)  = Eigen::Vector2d(-g[1], g[0]);
        }
        volume += point.weight;
        points_.push_back(point);
      }
    }
    for (Point &point : points_)
      point.weight /= volume;
    along_axis_.resize(points_.size());
    std::iota(along_axis_.begin(), along_axis_.end(), 0);
    std::sort(along_axis_.begin(), along_axis_.end(),
              [&](const std::size_t a, const std::size_t b) { return points_[a].axial_m < points_[b].axial_m; });
    root_m_   = points_[along_axis_.front()].axial_m;
    length_m_ = points_[along_axis_.back()].axial_m - root_m_;
  }

  BendingCoordinates::CellVector BendingCoordinates::in_plane(const std::size_t      cell,
                                                              const Eigen::VectorXd &displacement) const
  {
    const auto &nodes = nodes_[cell];
    CellVector  local(2 * nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a)
      local.segment<2>(2 * a) = displacement.segment<2>(dimension_ * nodes[a]);
    return local;
  }

  Eigen::VectorXd BendingCoordinates::rotations(const Eigen::VectorXd &displacement) const
  {
    Eigen::VectorXd angles(points_.size());
    for (std::size_t c = 0, p = 0; c < nodes_.size(); ++c)
    {
      const CellVector d = in_plane(c, displacement);
      for (const Point &point : points_of(c))
        angles[static_cast<Eigen::Index>(p++)] = std::atan2(point.spin.dot(d), 2. + point.trace.dot(d));
    }
    double last = 0.;
    for (const std::size_t p : along_axis_)
    {
      double &angle = angles[static_cast<Eigen::Index>(p)];
      angle += 2. * std::numbers::pi * std::round((last - angle) / (2. * std::numbers::pi));
      last = angle;
    }
    return angles;
  }

  Eigen::MatrixXd BendingCoordinates::axial_polynomials() const
  {
    const auto      m = static_cast<Eigen::Index>(points_.size());
    Eigen::MatrixXd values(m, n_axial_polynomials);
    for (Eigen::Index p = 0; p < m; ++p)
    {
      const double x = 2. * (points_[p].axial_m - root_m_) / length_m_ - 1.;
      values(p, 0)   = 1.;
      values(p, 1)   = x;
      for (int k = 2; k < n_axial_polynomials; ++k) // Legendre's recursion
        values(p, k) = ((2. * k - 1.) * x * values(p, k - 1) - (k - 1.) * values(p, k - 2)) / k;
    }
    for (int k = 0; k < n_axial_polynomials; ++k) // Gram and Schmidt, twice
      for (int pass = 0; pass < 2; ++pass)
      {
        const auto mean = [&](const Eigen::VectorXd &a, const Eigen::VectorXd &b) {
          double sum = 0.;
          for (Eigen::Index p = 0; p < m; ++p)
            sum += points_[p].weight * a[p] * b[p];
          return sum;
        };
        for (int j = 0; j < k; ++j)
          values.col(k) -= mean(values.col(j), values.col(k)) * values.col(j);
        values.col(k) /= std::sqrt(mean(values.col(k), values.col(k)));
      }
    return values;
  }

  void BendingCoordinates::choose_modes(const Eigen::MatrixXd &displacements, const int n)
  {
    const Eigen::MatrixXd polynomials = axial_polynomials();
    modes_                            = polynomials;
    singular_values_                  = Eigen::VectorXd::Zero(n_axial_polynomials);
    if (displacements.cols() > 0)
    {
      const Eigen::MatrixXd seen  = of(displacements) / length_m_;
      const SymmetricEigen  eigen = symmetric_eigen(seen * seen.transpose() / static_cast<double>(seen.cols()));
      modes_                      = polynomials * eigen.vectors.rowwise().reverse();
      singular_values_            = eigen.values.reverse().cwiseMax(0.).cwiseSqrt();
    }
    modes_ = modes_.leftCols(n).eval();
  }

  Eigen::MatrixXd BendingCoordinates::of(const Eigen::MatrixXd &displacements) const
  {
    Eigen::MatrixXd weighted = length_m_ * modes_;
    for (Eigen::Index p = 0; p < weighted.rows(); ++p)
      weighted.row(p) *= points_[p].weight;
    Eigen::MatrixXd q(modes_.cols(), displacements.cols());
    for (Eigen::Index k = 0; k < displacements.cols(); ++k)
      q.col(k) = weighted.transpose() * rotations(displacements.col(k));
    return q;
  }

  template BendingCoordinates::BendingCoordinates(const Swimmer<2> &);
  template BendingCoordinates::BendingCoordinates(const Swimmer<3> &);
} // namespace swimtwin
