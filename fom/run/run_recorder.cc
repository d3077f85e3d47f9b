#include <fom/run/run_recorder.h>

#include <datasets/scene/mirror_plane.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// The angle closest to a previous one among those that differ by full turns.
    double unwrap(const double angle, const double previous)
    {
      return angle + 2. * std::numbers::pi * std::round((previous - angle) / (2. * std::numbers::pi));
    }

    template <int dim>
    constexpr unsigned int first_shape_entry = dim == 3 ? 12 : 7;

    /// Laboratory position of the tip, or of the back of a head without a tail.
    template <int dim>
    Point<dim> tip_of(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration)
    {
      if (swimmer.has_tail())
        return swimmer.tail_positions(configuration)[swimmer.tail().axis_at_tip[2]];
      Tensor<1, dim> back;
      back[0] = swimmer.scene().head.size_m[0] / 2;
      return configuration.pose.to_laboratory(back);
    }
  } // namespace

  template <int dim>
  void RunRecorder<dim>::note_space(const FullOrderModel<dim> &model, TrajectoryRow &row) const
  {
    if constexpr (dim == 3)
    {
      const auto &configuration                         = model.now().configuration;
      const auto &pose                                  = configuration.pose;
      const auto &[force_that_holds, torque_that_holds] = model.balance().load_that_holds_head;
      const auto &[force_of_fluid, torque_of_fluid]     = model.balance().load_of_fluid;
      row.head_angle_rad =
          unwrap(pose.heading(), trajectory_.empty() ? scene_.head.angle_rad : trajectory_.back().head_angle_rad);
      row.head_z_m           = pose.center[2];
      row.tail_tip_z_m       = tip_of(model.swimmer(), configuration)[2];
      row.head_qw            = pose.quaternion.w();
      row.head_qx            = pose.quaternion.x();
      row.head_qy            = pose.quaternion.y();
      row.head_qz            = pose.quaternion.z();
      row.bz_T               = scene_.field(model.now().time_s)[2];
      row.head_force_z_N     = force_that_holds[2];
      row.head_torque_x_N_m  = torque_that_holds[0];
      row.head_torque_y_N_m  = torque_that_holds[1];
      row.fluid_force_z_N    = force_of_fluid[2];
      row.fluid_torque_x_N_m = torque_of_fluid[0];
      row.fluid_torque_y_N_m = torque_of_fluid[1];
    }
  }

  template <int dim>
  bool RunRecorder<dim>::is_snapshot(const int grid_step) const
  {
    const int per_period = scene_.output.snapshots_per_period;
    return scene_.tail && per_period > 0 && grid_step % std::max(1, scene_.time.steps_per_period / per_period) == 0;
  }

  template <int dim>
  void RunRecorder<dim>::note(const FullOrderModel<dim> &model, const int grid_step)
  {
    const auto &[time, configuration, rates] = model.now();
    const auto         &pose                 = configuration.pose;
    const PowerBalance &balance              = model.balance();
    const auto          field                = scene_.field(time);
    const Load         &holding = balance.load_that_holds_head, &of_fluid = balance.load_of_fluid;

    TrajectoryRow row;
    row.time_s         = time;
    row.head_x_m       = pose.center[0];
    row.head_y_m       = pose.center[1];
    row.head_angle_rad = pose.heading();
    note_space(model, row);
    const auto tip     = tip_of(model.swimmer(), configuration);
    row.tail_tip_x_m   = tip[0];
    row.tail_tip_y_m   = tip[1];
    const double angle = model.swimmer().tail_angle(configuration);
    row.tail_angle_rad = unwrap(angle, trajectory_.empty() ? row.head_angle_rad : trajectory_.back().tail_angle_rad);
    row.bx_T           = field[0];
    row.by_T           = field[1];
    row.magnetic_power_W_m  = balance.magnetic;
    row.external_power_W_m  = balance.gravity + balance.wall + balance.drive;
    row.dissipation_W_m     = balance.dissipation;
    row.elastic_energy_J_m  = balance.elastic_energy;
    row.kinetic_energy_J_m  = balance.kinetic_energy;
    row.kinetic_outflow_W_m = balance.kinetic_outflow;
    row.kinetic_growth_W_m  = balance.kinetic_growth;
    row.stabilization_W_m   = balance.stabilization;
    row.head_force_x_N_m    = holding.force[0];
    row.head_force_y_N_m    = holding.force[1];
    row.head_torque_N       = holding.torque[2];
    row.fluid_force_x_N_m   = of_fluid.force[0];
    row.fluid_force_y_N_m   = of_fluid.force[1];
    row.fluid_torque_N      = of_fluid.torque[2];
    row.coupling_iterations = model.coupling_iterations_of_last_step();
    row.n_unknowns          = model.n_unknowns();
    row.remeshed            = model.just_remeshed();
    trajectory_.push_back(row);
    if (const auto &work = model.work_of_last_step())
      first_works_.push_back(*work);

    if (!is_snapshot(grid_step))
      return;
    const TrajectoryRow &now = trajectory_.back();
    std::vector<double>  shape{time, pose.center[0], pose.center[1], now.head_angle_rad, field[0], field[1], field[2]};
    if (dim == 3)
      shape.insert(shape.end(), {now.head_z_m, now.head_qw, now.head_qx, now.head_qy, now.head_qz});
    for (const auto *nodal : {&configuration.shape, &rates.shape_rate})
      for (const auto &value : *nodal)
        shape.insert(shape.end(), value.begin_raw(), value.end_raw());
    shapes_.push_back(std::move(shape));
  }

  template <int dim>
  SnapshotSet RunRecorder<dim>::snapshots(const Swimmer<dim> &swimmer) const
  {
    const auto        &tail = swimmer.tail();
    const unsigned int n    = tail.mesh.n_nodes();
    SnapshotSet        set;
    set.tail_nodes_m.resize(n, dim);
    for (unsigned int a = 0; a < n; ++a)
      for (int i = 0; i < dim; ++i)
        set.tail_nodes_m(a, i) = tail.mesh.nodes[a][i];
    set.tail_cells.resize(tail.mesh.n_cells(), n_cell_nodes<dim>);
    for (unsigned int c = 0; c < tail.mesh.n_cells(); ++c)
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        set.tail_cells(c, a) = tail.mesh.cells[c][a];
    set.clamped_nodes.resize(tail.clamped_nodes.size());
    std::copy(tail.clamped_nodes.begin(), tail.clamped_nodes.end(), set.clamped_nodes.begin());

    std::vector<Eigen::Triplet<double>> mass;
    for (unsigned int c = 0; c < tail.mesh.n_cells(); ++c)
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
          for (int i = 0; i < dim; ++i)
            mass.emplace_back(dim * tail.mesh.cells[c][a] + i, dim * tail.mesh.cells[c][b] + i,
                              swimmer.elasticity().cell_mass(c, a, b));
    set.tail_mass_m2.resize(dim * n, dim * n);
    set.tail_mass_m2.setFromTriplets(mass.begin(), mass.end());

    const unsigned int m = shapes_.size();
    set.pose.resize(m, 3);
    if (!way_out_of_plane(scene_).empty())
      set.pose_in_space.resize(m, 7);
    set.field_T.resize(m, 3);
    set.tail_displacement_m.resize(m, dim * n);
    set.tail_velocity_m_s.resize(m, dim * n);
    for (unsigned int k = 0; k < m; ++k)
    {
      const double *entry = shapes_[k].data();
      set.time_s.push_back(entry[0]);
      set.pose.row(k)    = Eigen::RowVector3d(entry[1], entry[2], entry[3]);
      set.field_T.row(k) = Eigen::RowVector3d(entry[4], entry[5], entry[6]);
      if (set.pose_in_space.size() > 0)
        set.pose_in_space.row(k) << entry[1], entry[2], Eigen::Map<const Eigen::Matrix<double, 1, 5>>(entry + 7);
      set.tail_displacement_m.row(k) = Eigen::Map<const Eigen::RowVectorXd>(entry + first_shape_entry<dim>, dim * n);
      set.tail_velocity_m_s.row(k) =
          Eigen::Map<const Eigen::RowVectorXd>(entry + first_shape_entry<dim> + dim * n, dim * n);
    }
    return set;
  }

  template <int dim>
  std::vector<std::vector<double>> RunRecorder<dim>::rows() const
  {
    std::vector<std::vector<double>> result;
    for (const auto &row : trajectory_)
      result.push_back(numbers_of(row));
    return result;
  }

  template <int dim>
  void RunRecorder<dim>::restore(const std::vector<std::vector<double>> &rows, std::vector<std::vector<double>> shapes,
                                 std::vector<IntervalWork> first_works)
  {
    first_works_ = std::move(first_works);
    trajectory_.clear();
    for (const auto &row : rows)
      trajectory_.push_back(row_of(row));
    shapes_ = std::move(shapes);
  }

  template class RunRecorder<2>;
  template class RunRecorder<3>;
} // namespace swimtwin
