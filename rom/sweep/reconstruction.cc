#include <rom/sweep/reconstruction.h>
#include <rom/sweep/tail_mass_matrix.h>
#include <rom/swimmer/shape_amplitudes.h>

namespace swimtwin
{
  namespace
  {
    Eigen::VectorXi clamped_nodes(const ReducedTail &tail)
    {
      std::vector<int> clamped;
      for (int i = 0; i < tail.nodes_m.rows(); ++i)
        if (tail.modes.middleRows(tail.dimension() * i, tail.dimension()).isZero(0.))
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
    const Eigen::VectorXd d = tail_displacement(tail, state.segment(3, tail.n_coordinates()));
    Eigen::MatrixXd       x = tail.nodes_m + d.reshaped<Eigen::RowMajor>(tail.nodes_m.rows(), tail.nodes_m.cols());
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(state[2]).toRotationMatrix();
    x.leftCols<2>()         = ((x.leftCols<2>() * R.transpose()).rowwise() + state.head<2>().transpose()).eval();
    return x;
  }

  SnapshotSet reconstruct(const ReducedTail &tail, const Drive &drive, const std::vector<ReducedSnapshot> &snapshots)
  {
    const auto         n = static_cast<Eigen::Index>(snapshots.size());
    const Eigen::Index r = tail.n_coordinates();
    SnapshotSet        set;
    set.tail_nodes_m        = tail.nodes_m;
    set.tail_cells          = tail.cells;
    set.clamped_nodes       = clamped_nodes(tail);
    set.tail_mass_m2        = tail_mass_matrix(tail.nodes_m, tail.cells);
    set.tail_displacement_m = Eigen::MatrixXd(n, tail.nodes_m.size());
    set.tail_velocity_m_s   = Eigen::MatrixXd(n, tail.nodes_m.size());
    set.pose                = Eigen::MatrixXd(n, 3);
    set.field_T             = Eigen::MatrixXd::Zero(n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const auto &[phase, state, rate] = snapshots[static_cast<std::size_t>(i)];
      set.time_s.push_back(phase / drive.frequency_Hz);
      set.tail_displacement_m.row(i) = tail_displacement(tail, state.segment(3, r));
      set.tail_velocity_m_s.row(i)   = tail_velocity(tail, state.segment(3, r), rate.segment(3, r));
      set.pose.row(i)                = state.head<3>();
      set.field_T.row(i).head<2>()   = drive.field->value_T(phase, drive.parameters);
    }
    return set;
  }
} // namespace swimtwin
