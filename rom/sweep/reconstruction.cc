#include <rom/sweep/reconstruction.h>
#include <rom/swimmer/shape_amplitudes.h>

#include <array>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    struct QuadraturePoint
    {
      double xi = 0., eta = 0., weight = 0.;
    };

    /// Degree 6 (Dunavant 1985, 12 points): exact for products of quadratic shape functions on straight triangles and,
    /// with the quadratic Jacobian determinant, on curved ones.
    std::vector<QuadraturePoint> triangle_quadrature()
    {
      std::vector<QuadraturePoint> points;
      const auto                   add = [&](const double a, const double b, const double weight) {
        const double c = 1. - a - b;
        for (const auto &[xi, eta] : {std::pair{a, b}, {b, c}, {c, a}})
          points.push_back({xi, eta, 0.5 * weight});
      };
      add(0.249286745170910, 0.249286745170910, 0.116786275726379);
      add(0.063089014491502, 0.063089014491502, 0.050844906370207);
      add(0.310352451033785, 0.053145049844816, 0.082851075618374);
      add(0.053145049844816, 0.310352451033785, 0.082851075618374);
      return points;
    }

    using CellValues = Eigen::Matrix<double, 6, 1>;

    CellValues shape_functions(const double x, const double y)
    {
      const double z = 1. - x - y;
      return {z * (2. * z - 1.), x * (2. * x - 1.), y * (2. * y - 1.), 4. * x * z, 4. * x * y, 4. * y * z};
    }

    Eigen::Matrix<double, 2, 6> shape_gradients(const double x, const double y)
    {
      const double                z = 1. - x - y;
      Eigen::Matrix<double, 2, 6> gradients;
      gradients << 1. - 4. * z, 4. * x - 1., 0., 4. * (z - x), 4. * y, -4. * y, //
          1. - 4. * z, 0., 4. * y - 1., -4. * x, 4. * x, 4. * (z - y);
      return gradients;
    }

    Eigen::SparseMatrix<double> mass_matrix(const ReducedTail &tail)
    {
      std::vector<Eigen::Triplet<double>> entries;
      const auto                          quadrature = triangle_quadrature();
      for (Eigen::Index c = 0; c < tail.cells.rows(); ++c)
      {
        Eigen::Matrix<double, 6, 6> mass = Eigen::Matrix<double, 6, 6>::Zero();
        Eigen::Matrix<double, 6, 2> nodes;
        for (int i = 0; i < 6; ++i)
          nodes.row(i) = tail.nodes_m.row(tail.cells(c, i));
        for (const auto &[x, y, weight] : quadrature)
        {
          const CellValues N = shape_functions(x, y);
          mass += weight * std::abs((shape_gradients(x, y) * nodes).determinant()) * N * N.transpose();
        }
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j)
            for (int component = 0; component < 2; ++component)
              entries.emplace_back(2 * tail.cells(c, i) + component, 2 * tail.cells(c, j) + component, mass(i, j));
      }
      Eigen::SparseMatrix<double> matrix(tail.nodes_m.size(), tail.nodes_m.size());
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }

    Eigen::VectorXi clamped_nodes(const ReducedTail &tail)
    {
      std::vector<int> clamped;
      for (int i = 0; i < tail.nodes_m.rows(); ++i)
        if (tail.modes.middleRows(2 * i, 2).isZero(0.))
          clamped.push_back(i);
      return Eigen::VectorXi::Map(clamped.data(), static_cast<Eigen::Index>(clamped.size()));
    }
  } // namespace

  Eigen::VectorXd tail_displacement(const ReducedTail &tail, const ShapeVector &q)
  {
    return tail.modes * ShapeAmplitudes(tail).value(q);
  }

  Eigen::VectorXd tail_velocity(const ReducedTail &tail, const ShapeVector &q, const ShapeVector &rate)
  {
    return tail.modes * (ShapeAmplitudes(tail).slopes(q) * rate);
  }

  Eigen::MatrixXd tail_positions(const ReducedTail &tail, const SwimmerState &state)
  {
    const Eigen::VectorXd d = tail_displacement(tail, state.tail(tail.n_coordinates()));
    const Eigen::MatrixXd in_head_frame =
        tail.nodes_m +
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>(d.data(), tail.nodes_m.rows(), 2);
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(state[2]).toRotationMatrix();
    return (in_head_frame * R.transpose()).rowwise() + state.head<2>().transpose();
  }

  SnapshotSet reconstruct(const ReducedTail &tail, const Drive &drive, const std::vector<ReducedSnapshot> &snapshots)
  {
    const auto         n = static_cast<Eigen::Index>(snapshots.size());
    const Eigen::Index r = tail.n_coordinates();
    SnapshotSet        set;
    set.tail_nodes_m        = tail.nodes_m;
    set.tail_cells          = tail.cells;
    set.clamped_nodes       = clamped_nodes(tail);
    set.tail_mass_m2        = mass_matrix(tail);
    set.tail_displacement_m = Eigen::MatrixXd(n, tail.nodes_m.size());
    set.tail_velocity_m_s   = Eigen::MatrixXd(n, tail.nodes_m.size());
    set.pose                = Eigen::MatrixXd(n, 3);
    set.field_T             = Eigen::MatrixXd::Zero(n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const auto &[phase, state, rate] = snapshots[static_cast<std::size_t>(i)];
      set.time_s.push_back(phase / drive.frequency_Hz);
      set.tail_displacement_m.row(i) = tail_displacement(tail, state.tail(r));
      set.tail_velocity_m_s.row(i)   = tail_velocity(tail, state.tail(r), rate.tail(r));
      set.pose.row(i)                = state.head<3>();
      set.field_T.row(i).head<2>()   = drive.field->value_T(phase, drive.parameters);
    }
    return set;
  }
} // namespace swimtwin
