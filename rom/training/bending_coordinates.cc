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

    BendingCoordinates::NodeDerivative gather(const Eigen::VectorXd &field, const std::array<unsigned int, 6> &nodes)
    {
      BendingCoordinates::NodeDerivative local;
      for (int a = 0; a < 6; ++a)
        local.segment<2>(2 * a) = field.segment<2>(2 * nodes[a]);
      return local;
    }
  } // namespace

  BendingCoordinates::BendingCoordinates(const Swimmer<2> &swimmer)
  {
    const auto          &mesh = swimmer.tail().mesh;
    IsoparametricCell<2> map;
    double               area = 0.;
    for (const auto &nodes : mesh.cells)
    {
      const auto x = cell_positions<2>(nodes, mesh.nodes);
      map.reinit(x);
      for (unsigned int q = 0; q < map.n_points(); ++q)
      {
        Point point;
        point.trace.setZero();
        point.spin.setZero();
        for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const auto &g          = map.gradient(q, a);
          point.nodes[a]         = nodes[a];
          point.trace[2 * a]     = g[0];
          point.trace[2 * a + 1] = g[1];
          point.spin[2 * a]      = -g[1];
          point.spin[2 * a + 1]  = g[0];
        }
        point.axial_m = map.position(q, x)[0];
        point.weight  = map.weight(q);
        area += point.weight;
        points_.push_back(point);
      }
    }
    for (Point &point : points_)
      point.weight /= area;
    along_axis_.resize(points_.size());
    std::iota(along_axis_.begin(), along_axis_.end(), 0);
    std::sort(along_axis_.begin(), along_axis_.end(),
              [&](const std::size_t a, const std::size_t b) { return points_[a].axial_m < points_[b].axial_m; });
    root_m_   = points_[along_axis_.front()].axial_m;
    length_m_ = points_[along_axis_.back()].axial_m - root_m_;
  }

  Eigen::VectorXd BendingCoordinates::rotations(const Eigen::VectorXd &displacement) const
  {
    Eigen::VectorXd angles(points_.size());
    double          last = 0.;
    for (const std::size_t p : along_axis_)
    {
      const Point         &point = points_[p];
      const NodeDerivative d     = gather(displacement, point.nodes);
      const double         angle = std::atan2(point.spin.dot(d), 2. + point.trace.dot(d));
      last                       = angle + 2. * std::numbers::pi * std::round((last - angle) / (2. * std::numbers::pi));
      angles[static_cast<Eigen::Index>(p)] = last;
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
} // namespace swimtwin
