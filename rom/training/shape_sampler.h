// Resistance of the reduced swimmer at many shapes, shared out over ranks.
#pragma once

#include <rom/training/posed_fluid.h>
#include <rom/training/sample_store.h>
#include <rom/training/tail_basis.h>

#include <functional>
#include <optional>

namespace swimtwin
{
  struct ResistanceSample
  {
    ShapePoint      point;
    Eigen::MatrixXd resistance; ///< unit viscosity, in 2D per unit depth, (r + 3) x (r + 3): R^T dx/dt, omega, dq/dt
  };

  /// Of a body at any shape and pose, by the full-order fluid.
  template <int dim>
  class ShapeResistance
  {
  public:
    /// All must outlive this.
    ShapeResistance(const Swimmer<dim> &swimmer, const TailBasis &basis, const UsualPlace &place);

    /// None where the tail is inside out or the fluid cannot be meshed.
    std::optional<Eigen::MatrixXd> at(const ShapePoint &point);

  private:
    const Swimmer<dim> &swimmer_;
    const TailBasis    &basis_;
    const UsualPlace   &place_;
    PosedFluid<dim>     fluid_;
  };

  class ShapeSampler
  {
  public:
    using Resistance = std::function<std::optional<Eigen::MatrixXd>(const ShapePoint &)>;

    /// What the store has is not computed again, and it grows as samples come; it must outlive this. `n_coordinates` of
    /// the points. Collective.
    ShapeSampler(Resistance resistance, int n_coordinates, SampleStore &store, MPI_Comm communicator);

    /// Samples in the order of the points; without those shapes that have no resistance. Collective.
    std::vector<ResistanceSample> sample(const std::vector<ShapePoint>       &points,
                                         const std::function<void(int, int)> &on_progress = {});

  private:
    void compute(const std::vector<ShapePoint> &points);

    Resistance   resistance_;
    int          n_coordinates_;
    SampleStore &store_;
    MPI_Comm     communicator_;
  };
} // namespace swimtwin
