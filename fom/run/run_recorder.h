// What is kept of a run: one row per step of the time grid, and snapshots of the tail's shape.
#pragma once

#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <fom/step/full_order_model.h>

namespace swimtwin
{
  template <int dim>
  class RunRecorder
  {
  public:
    explicit RunRecorder(const Scene &scene) : scene_(scene) {}

    /// Note the model's present instant, after `grid_step` steps of the time grid.
    void note(const FullOrderModel<dim> &model, int grid_step);

    const Trajectory &trajectory() const { return trajectory_; }
    /// Works of the first intervals between rows, where powers do not tell them (fom/step/start_work.h).
    const std::vector<IntervalWork> &first_works() const { return first_works_; }
    /// Tail mesh, mass matrix and the shapes noted so far.
    SnapshotSet snapshots(const Swimmer<dim> &swimmer) const;

    /// Flat copies for a checkpoint: rows of numbers.
    std::vector<std::vector<double>> rows() const;
    std::vector<std::vector<double>> shapes() const { return shapes_; }
    void restore(const std::vector<std::vector<double>> &rows, std::vector<std::vector<double>> shapes,
                 std::vector<IntervalWork> first_works);

  private:
    bool is_snapshot(int grid_step) const;
    /// What a plane has not.
    void note_space(const FullOrderModel<dim> &model, TrajectoryRow &row) const;

    const Scene              &scene_;
    Trajectory                trajectory_;
    std::vector<IntervalWork> first_works_;
    /// Time, pose (x, y, angle), field (3), in space z and quaternion (w, x, y, z), displacement (n), velocity (n).
    std::vector<std::vector<double>> shapes_;
  };
} // namespace swimtwin
